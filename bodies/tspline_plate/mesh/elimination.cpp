#include "tspline_plate/mesh/elimination.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace trammel::plate {

namespace {

constexpr double round_off = 1e-12;  // of coefficients relative to the largest of their condition

}  // namespace

// Held components are replaced until only free ones are left; relations never point back, so this ends.
void Elimination::substitute(std::vector<Term>& sum) const {
  std::map<int, double> free;
  while (!sum.empty()) {
    const Term term = sum.back();
    sum.pop_back();
    if (!held_[std::size_t(term.component)]) {
      free[term.component] += term.factor;
      continue;
    }
    for (const Term& t : relation_[std::size_t(term.component)]) sum.push_back({t.component, term.factor * t.factor});
  }
  for (const auto& [component, factor] : free) sum.push_back({component, factor});
}

void Elimination::hold(std::vector<Term> condition, double known_to) {
  double scale = 0;
  for (const Term& t : condition) scale = std::max(scale, std::abs(t.factor));
  substitute(condition);
  std::erase_if(condition, [&](const Term& t) { return std::abs(t.factor) <= round_off * scale; });
  const auto unknown = [&](const Term& t) { return std::abs(t.factor) <= known_to * scale; };
  if (std::all_of(condition.begin(), condition.end(), unknown)) return;

  const Term* pivot = &condition.front();
  for (const Term& t : condition)
    if (std::abs(t.factor) >= (1 - round_off) * std::abs(pivot->factor)) pivot = &t;
  const Term removed = *pivot;
  held_[std::size_t(removed.component)] = true;
  auto& relation = relation_[std::size_t(removed.component)];
  for (const Term& t : condition)
    if (t.component != removed.component) relation.push_back({t.component, -t.factor / removed.factor});
}

void Elimination::finish() {
  std::vector<int> coordinate(held_.size(), -1);
  for (std::size_t c = 0; c < held_.size(); ++c)
    if (!held_[c]) {
      coordinate[c] = int(kept_.size());
      kept_.push_back(int(c));
    }
  std::vector<std::vector<Term>> expanded(held_.size());
  for (std::size_t c = 0; c < held_.size(); ++c) {
    expanded[c] = {{int(c), 1}};
    substitute(expanded[c]);
    for (Term& t : expanded[c]) t.component = coordinate[std::size_t(t.component)];
  }
  relation_ = std::move(expanded);
}

void Elimination::expand(In q, Eigen::Ref<Vec> u) const {
  for (Eigen::Index c = 0; c < u.size(); ++c) {
    u(c) = 0;
    for (const Term& t : relation_[std::size_t(c)]) u(c) += t.factor * q(t.component);
  }
}

void Elimination::restrict(const Vec& f, Out of_q) const {
  for (Eigen::Index c = 0; c < f.size(); ++c)
    for (const Term& t : relation_[std::size_t(c)]) of_q(t.component) += t.factor * f(c);
}

}  // namespace trammel::plate
