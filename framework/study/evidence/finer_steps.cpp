#include "study/evidence/finer_steps.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulate/start/setup.hpp"
#include "study/cases/json_text.hpp"

namespace trammel::study {
namespace {

using json = nlohmann::ordered_json;

constexpr double halved = 0.5, tolerance_divided = 10;

json finer(const simulate::StepChoice& step, const json& written) {
  if (step.fixed) return halved * *step.fixed;
  json object = written.is_object() ? written : json::object();
  object["tolerance"] = step.tolerance.relative / tolerance_divided;
  object.erase("absolute");  // it follows the tolerance
  return object;
}

std::string in_words(const simulate::StepChoice& step) {
  return step.fixed ? fmt::format("step {:.3g} s", halved * *step.fixed)
                    : fmt::format("tolerance {:.2g}", step.tolerance.relative / tolerance_divided);
}

}  // namespace

FinerSteps finer_steps(const SceneSource& source, plugin::Registry& registry) {
  const scene::Scene scene = source.with();
  const simulate::Setup setup = simulate::set_up(scene, registry);
  const simulate::Settings& s = setup.settings;
  const scene::Value* written = scene.root().find("integrator");
  json object = written && written->type() == scene::Value::Type::object ? json::parse(json_text(*written)) : json();
  if (!object.is_object()) object = {{"type", setup.integrator_type}};
  object["step"] = finer(s.step, object.value("step", json()));
  if (s.own_contact_step) object["contact_step"] = finer(s.contact_step, object.value("contact_step", json()));
  const int order = setup.integrator->traits().order;
  return {.change = {{"integrator", object.dump()}},
          .what = fmt::format("{} with {}", setup.integrator_type, in_words(s.step)),
          .type = setup.integrator_type,
          .share = s.step.fixed ? 1 - std::pow(halved, order) : 1 - 1 / tolerance_divided};
}

}  // namespace trammel::study
