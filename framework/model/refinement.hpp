// Bodies replace their coordinates during a run (a mesh that refines): each is asked, the model is laid out anew, and the
// bodies' transfers are joined to one of the whole system.
#pragma once

#include <memory>
#include <vector>

#include "model/model.hpp"

namespace trammel::model {

// The system's transfer: each body's own on its segments, the others' passed through.
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

// Asks the bodies of `asked` (indices) to refine, each for its cause, with q and v of the whole system. Null: none did and
// nothing changed. Else the model has its new layout, `refined` names the bodies that did, and every AssembledSystem of the model
// must be told (lay_out).
std::unique_ptr<JoinedTransfer> refine(Model& model, double t, const Vec& q, const Vec& v,
                                       const std::vector<int>& asked, const std::vector<RefineCause>& causes,
                                       std::vector<int>& refined);

}  // namespace trammel::model
