#include "commands/component_cost.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace trammel::simulate {

namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

// [s] The least time of several calls.
double least_time(const std::function<void()>& call) {
  constexpr double enough = 5e-5;
  double least = std::numeric_limits<double>::infinity(), all = 0;
  do {
    const Clock::time_point begin = Clock::now();
    call();
    const double passed = std::chrono::duration<double>(Clock::now() - begin).count();
    least = std::min(least, passed), all += passed;
  } while (all < enough);
  return least;
}

struct PartsOfAKind {
  int count = 0;
  double once = 0;  // [s]
};

class Costs {
 public:
  Costs(model::AssembledSystem& system, const State& state) : system_(system), state_(state) {}

  Json measured() {
    const model::Model& model = system_.model();
    for (const model::BodyEntry& entry : model.bodies) add(entry.origin.component, [&] { evaluate(entry); });
    for (const model::JointEntry& entry : model.joints) add(entry.origin.component, [&] { evaluate(entry); });
    for (const model::ForceEntry& entry : model.forces) add(entry.origin.component, [&] { evaluate(entry); });
    for (std::size_t i = 0; i < model.contacts.size(); ++i)
      if (!model.contacts[i].joint) add(model.contacts[i].origin.component, [&] { evaluate_contact(int(i)); });
    return json();
  }

 private:
  void add(const std::string& component, const std::function<void()>& evaluate) {
    PartsOfAKind& kind = kinds_[component];
    if (kind.count++ == 0) kind.once = least_time(evaluate);
  }

  void evaluate(const model::BodyEntry& entry) {
    const auto q = state_.q.segment(entry.q0, entry.nq), v = state_.v.segment(entry.v0, entry.nv);
    M_.setZero(entry.nv, entry.nv), f_.setZero(entry.nv);
    Matrix target = Matrix::onto(M_);
    if (entry.mass_and_force) return entry.mass_and_force->mass_and_force(state_.t, q, v, target, f_);
    if (!entry.body->mass_is_constant()) entry.body->mass(state_.t, q, target);
    entry.body->force(state_.t, q, v, f_);
  }
  void evaluate(const model::JointEntry& entry) {
    if (const auto* joint = dynamic_cast<const Joint*>(entry.joint.get())) {
      const Motion A = system_.motion(entry.markers[0]), &B = system_.motion(entry.markers[1]);
      rows_.resize(entry.rows, system_.model().world.space);
      joint->rows(state_.t, A, B, rows_);
    }
  }
  void evaluate(const model::ForceEntry& entry) {
    const Motion A = system_.motion(entry.A), &B = system_.motion(entry.B);
    const Space space = system_.model().world.space;
    Wrench on_A = Wrench::Zero(dimension(space) + rotations(space)), on_B = on_A;
    entry.force->wrench(state_.t, A, B, on_A, on_B);
  }
  void evaluate_contact(int i) {
    system_.move_to(state_.t, state_.q, state_.v);
    system_.gap(i), system_.gap_rate(i);
  }

  Json json() const {
    std::vector<std::pair<std::string, PartsOfAKind>> all(kinds_.begin(), kinds_.end());
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
      return a.second.count * a.second.once > b.second.count * b.second.once;
    });
    Json list = Json::array();
    for (const auto& [component, kind] : all) {
      const auto space = component.find(' ');  // "body rigid_body"
      list.push_back({{"component", component.substr(space == component.npos ? 0 : space + 1)},
                      {"kind", component.substr(0, std::min(space, component.size()))},
                      {"count", kind.count},
                      {"microseconds", 1e6 * kind.count * kind.once}});
    }
    return list;
  }

  model::AssembledSystem& system_;
  const State& state_;
  std::map<std::string, PartsOfAKind> kinds_;
  Mat M_;
  Vec f_;
  Rows rows_;
};

}  // namespace

Json component_costs(model::AssembledSystem& system, const State& state) {
  try {
    system.move_to(state.t, state.q, state.v);
    return Costs(system, state).measured();
  } catch (const std::exception&) {
    return Json::array();
  }
}

}  // namespace trammel::simulate
