#include "study/study_figures.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "model/scene_keys.hpp"
#include "scene/suggestion.hpp"
#include "study/cases/json_text.hpp"

namespace trammel::study {
namespace {

using scene::Problems;
using scene::Value;
using Type = Value::Type;
using Texts = std::vector<std::string>;

// 1e-6 and 0.000001 are the same value; "" stands for none.
bool same(const std::string& text, const Value& wanted) {
  if (text.empty()) return wanted.type() == Type::null;
  return wanted.type() != Type::null && nlohmann::json::parse(text) == nlohmann::json::parse(json_text(wanted));
}

class Reader {
 public:
  Reader(const Texts& paths, const std::vector<Texts>& values, Problems& problems)
      : paths_(paths), values_(values), problems_(problems) {}

  StudyFigure read(const Value& one) {
    StudyFigure figure;
    if (!model::check_keys(one, {"title", "observe", "cases", "scale", "time"}, problems_)) return figure;
    if (const Value* title = one.find("title")) figure.title = title->read_text(problems_).value_or("");
    if (const Value* observe = one.find("observe"))
      figure.observe = columns(*observe);
    else
      problems_.error(one.problem("has no \"observe\": a column of the cases' records, or a list"));
    figure.log = logarithmic(one, "scale"), figure.log_time = logarithmic(one, "time");
    const Value* cases = one.find("cases");
    if (cases && !meaningful(*cases)) return figure;
    for (std::size_t i = 0; i < values_.size(); ++i)
      if (!cases || chosen(*cases, i)) figure.cases.push_back(i);
    if (figure.cases.empty()) problems_.error((cases ? *cases : one).problem("no case has these values"));
    return figure;
  }

 private:
  Texts columns(const Value& observe) {
    Texts all;
    if (observe.type() != Type::array) return {observe.read_text(problems_).value_or("")};
    for (const Value& item : observe.items()) all.push_back(item.read_text(problems_).value_or(""));
    return all;
  }

  bool logarithmic(const Value& one, const char* key) {
    const Value* given = one.find(key);
    const std::string name = given ? given->read_text(problems_).value_or("linear") : "linear";
    if (name != "log" && name != "linear")
      problems_.error(
          given->problem(fmt::format("found \"{}\"{}", name, scene::did_you_mean(name, {"linear", "log"}))));
    return name == "log";
  }

  bool meaningful(const Value& cases) {
    if (cases.type() == Type::array)
      return std::all_of(cases.items().begin(), cases.items().end(), [this](const Value& v) { return meaningful(v); });
    const std::size_t before = problems_.errors().size();
    return model::check_keys(cases, paths_, problems_) && problems_.errors().size() == before;
  }

  bool chosen(const Value& cases, std::size_t i) const {
    if (cases.type() == Type::array)
      return std::any_of(cases.items().begin(), cases.items().end(), [&](const Value& v) { return chosen(v, i); });
    return std::all_of(cases.members().begin(), cases.members().end(), [&](const auto& member) {
      const auto k = std::size_t(std::find(paths_.begin(), paths_.end(), member.first) - paths_.begin());
      return same(values_[i][k], member.second);
    });
  }

  const Texts& paths_;
  const std::vector<Texts>& values_;
  Problems& problems_;
};

}  // namespace

std::vector<StudyFigure> read_figures(const Value& figures, const Texts& paths, const std::vector<Texts>& values,
                                      Problems& problems) {
  std::vector<StudyFigure> all;
  if (figures.type() != Type::array) {
    problems.error(figures.problem(fmt::format("found {}, expected a list of figures", figures.type_name())));
    return all;
  }
  Reader reader(paths, values, problems);
  for (const Value& one : figures.items()) all.push_back(reader.read(one));
  return all;
}

}  // namespace trammel::study
