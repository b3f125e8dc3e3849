// Whether contacts did what contacts can do, looked at in records and after events:
//
//     N >= 0,   |T| <= mu_0 N  [N],   work of friction <= 0 [J]      but for round-off
//
// and whether those that share rows can carry what they carry (AssembledSystem::spare_load).
// What does not is told in a warning: the run cannot be trusted there. It also keeps when contacts were statically
// indeterminate, closed with rows that depend on each other, so that their forces are one choice of many
// (complementarity/shares/carrying_rows.hpp).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "simulate/results/ledger.hpp"

namespace trammel::simulate {

class ContactAudit {
 public:
  void look(model::AssembledSystem& system, const State& state);

  struct Span {
    double first = 0, last = 0;  // [s]
  };
  const std::map<int, Span>& indeterminate() const { return indeterminate_; }  // by contact
  std::vector<std::string> warnings(const model::Model& model, const Ledger& ledger) const;

  void archive(Archive& a, std::size_t contacts);

 private:
  // The worst of a kind, relative to the largest normal force at that instant.
  struct Worst {
    int contact = -1;
    double t = 0, force = 0, relative = 0;
    void raise_to(int i, double when, double amount, double scale);
    void archive(Archive& a, const std::string& name);
  };
  void look_at_groups(model::AssembledSystem& system, double t, const Vec& lambda);

  Worst pull_, beyond_cone_, overloaded_;
  std::map<int, Span> indeterminate_;
};

}  // namespace trammel::simulate
