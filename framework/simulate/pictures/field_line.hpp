// A line of fields.ndjson: the fields of all bodies at one time.
//
//     {"t": 0.18, "bodies": {"plate": {"fields": ["von_mises_top", ...], "patches": [
//         {"along": 5, "points": [[x, y, z], ...], "values": [[of the first field at each point], ...]}, ...]}}}
#pragma once

#include <string>
#include <vector>

#include <trammel/fields.hpp>
#include <trammel/integrator.hpp>

#include "model/model.hpp"

namespace trammel::simulate {

class FieldLine {
 public:
  explicit FieldLine(const model::Model& model);
  bool possible() const { return !shown_.empty(); }  // some body has fields
  void append(const State& state, std::string& out);

 private:
  struct Shown {
    const model::BodyEntry* entry;
    const HasFields* fields;
  };
  std::vector<Shown> shown_;
  std::vector<FieldPatch> patches_;
};

}  // namespace trammel::simulate
