// A study: a scene or several, the values that vary, and the scalars that are kept of each run.
//
//     {
//       "study": 1,
//       "scene": "pendulum.json",                            relative to the study
//       "set": {"simulate.until": 5},                        of every case
//       "mode": "grid",                                      grid | zip | random | sobol; with a list of cases: list
//       "vary": {
//         "bodies.rod.length": [0.5, 1, 2],
//         "bodies.rod.mass": {"from": 0.1, "to": 10, "count": 5, "scale": "log"}
//       },
//       "count": 100, "seed": 1,                             of random and sobol, whose entries are ranges
//       "reduce": {"swing": {"observe": "theta", "as": "max"}},
//       "keep": true,                                        each case's results folder, as of `trammel run`
//       "figures": [{"observe": "theta"}]                    of its report (study_figures.hpp)
//     }
//
// or "vary": [{"a.b": 1}, {"a.b": 2, "a.c": 3}], a list of cases. The path "scene" varies the scene itself:
// "scene": ["hht.json", "baumgarte.json"]. In a grid the last path varies fastest. Random
// samples are of std::mt19937_64, Sobol points of Joe and Kuo's table in Boost, shifted modulo 1 by numbers of the seed
// if one is given: the cases of one file are the same on every machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/value.hpp"
#include "study/cases/scene_source.hpp"
#include "study/reduction.hpp"
#include "study/study_figures.hpp"

namespace trammel::study {

class Study {
 public:
  // Throws SceneError with all problems of the file, among them paths that its scene does not have.
  static Study load(const std::string& file, const std::vector<scene::Override>& overrides = {});
  // `text` as of `resolved`, for `study merge`: the scene is not read.
  static Study restore(const std::string& text, const std::string& file);

  std::size_t size() const { return cases_.size(); }
  const std::vector<std::string>& paths() const { return paths_; }
  // in the order of paths(); "" where a case of a list leaves a path unchanged
  const std::vector<std::string>& values(std::size_t i) const { return cases_[i]; }
  std::vector<scene::Override> overrides(std::size_t i) const;
  const std::vector<Reduction>& reductions() const { return reductions_; }
  const std::vector<std::string>& scene_files() const { return scene_files_; }  // in the order of their first cases
  std::size_t scene_of(std::size_t i) const { return scene_of_[i]; }            // index into scene_files()
  const std::vector<scene::Override>& set() const { return set_; }
  bool keep() const { return keep_; }
  const std::vector<StudyFigure>& figures() const { return figures_; }
  std::string title() const;  // empty: it has none
  std::string resolved() const { return definition_.resolved(); }
  // Hash of everything that decides the outcome of a case: the scene, the program's commit, values and reductions.
  std::uint64_t key(std::size_t i, std::uint64_t scene_hash) const;

 private:
  explicit Study(scene::Scene definition);
  void read(scene::Problems& problems);
  void read_vary(const scene::Value& root, scene::Problems& problems);
  std::optional<std::string> read_mode(const scene::Value& root, scene::Problems& problems) const;
  void read_list(const scene::Value& list, scene::Problems& problems);
  void read_samples(const scene::Value& root, const std::string& mode, scene::Problems& problems);
  void read_combinations(const scene::Value& vary, const std::string& mode, scene::Problems& problems);
  void combine_one_of_each(const scene::Value& vary, const std::vector<std::vector<std::string>>& lists,
                           scene::Problems& problems);
  void combine_each_with_each(const scene::Value& vary, const std::vector<std::vector<std::string>>& lists,
                              scene::Problems& problems);
  void read_scenes(const scene::Value& root, scene::Problems& problems);
  void check_against_scenes(scene::Problems& problems) const;
  void read_figures(const scene::Value& root, scene::Problems& problems);
  void check_observed(const scene::Scene& scene, std::size_t which, scene::Problems& problems) const;

  scene::Scene definition_;
  std::vector<std::string> scene_files_;
  std::vector<std::size_t> scene_of_;  // each case's
  std::vector<scene::Override> set_;
  std::vector<std::string> paths_;
  std::vector<std::vector<std::string>> cases_;  // JSON texts
  std::vector<Reduction> reductions_;
  std::uint64_t reductions_hash_ = 0;
  bool keep_ = false;
  std::vector<StudyFigure> figures_;
};

}  // namespace trammel::study
