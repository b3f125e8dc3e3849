// The change of least kinetic energy, as ideal internal forces would make it: see row_projection.hpp. Positions keep their centre of
// mass, velocities their linear and angular momentum; kinetic energy never grows.
#include <trammel/plugin.hpp>

#include "../row_projection.hpp"

namespace {

using namespace trammel;

class MassWeighted final : public Correction {
 public:
  bool corrects(Level level) const override { return level == Level::position || level == Level::velocity; }
  Outcome apply(Level level, System& s, const Step&, State& state) override {
    return level == Level::position ? projection_.position(s, state) : projection_.velocity(s, state);
  }

 private:
  RowProjection projection_{Blend{.c_m = 1}};
};

}  // namespace

TRAMMEL_PLUGIN(trammel::correction<MassWeighted>("mass_weighted",
                                                 "positions, velocities: the change that internal forces would make")
                   .source("Chen Xiangyang 2002, Chinese J. Comput. Mech. 19, 74-77"))
