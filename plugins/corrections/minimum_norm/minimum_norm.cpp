// The smallest change of the coordinates themselves, by the Moore-Penrose inverse of G: see row_projection.hpp. It does not know
// masses, so centre of mass and momentum move with it.
#include <trammel/plugin.hpp>

#include "../row_projection.hpp"

namespace {

using namespace trammel;

class MinimumNorm final : public Correction {
 public:
  bool corrects(Level level) const override { return level == Level::position || level == Level::velocity; }
  Outcome apply(Level level, System& s, const Step&, State& state) override {
    return level == Level::position ? projection_.position(s, state) : projection_.velocity(s, state);
  }

 private:
  RowProjection projection_{Blend{.c_m = 0, .c_1 = 1}};
};

}  // namespace

TRAMMEL_PLUGIN(trammel::correction<MinimumNorm>("minimum_norm",
                                                "positions, velocities: the smallest change of the coordinates")
                   .source("Chen Xiangyang 2002, Chinese J. Comput. Mech. 19, 74-77"))
