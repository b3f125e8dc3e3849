// Refinement: bodies replace their coordinates during a run. The model gets a new layout, and the bodies' transfers are
// combined to one of the whole system.
#pragma once

#include <memory>
#include <vector>

#include "model/model.hpp"

namespace trammel::model {

// The system's transfer: the transfer of each refined body on its segments, the identity for the others.
class JoinedTransfer final : public Transfer {
 public:
  struct Segment {
    int q0 = 0, nq = 0, v0 = 0, nv = 0;
  };
  struct Part {
    Segment old, fresh;
    std::unique_ptr<Transfer> transfer;  // null: nothing changed
  };
  explicit JoinedTransfer(std::vector<Part> parts) : parts_(std::move(parts)) {}
  void q(In old, Out fresh) const override;
  void v(In old, Out fresh) const override;

 private:
  std::vector<Part> parts_;
};

// Calls `refine` of the bodies in `asked` (indices), each with its cause; q and v belong to the whole system. Null: no
// body refined and nothing changed. Otherwise the model has a new layout, `refined` lists the refined bodies, and
// lay_out() must be called for every AssembledSystem of the model.
std::unique_ptr<JoinedTransfer> refine(Model& model, double t, const Vec& q, const Vec& v,
                                       const std::vector<int>& asked, const std::vector<RefineCause>& causes,
                                       std::vector<int>& refined);

}  // namespace trammel::model
