// A body without coordinates whose marker moves by a law of time, x = amplitude sin(rate t): all of its velocity is V_t.
#include <cmath>

#include <trammel/body.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct SwayingPoint : Body {
  Vec3 amplitude = Vec3::Zero(2);
  double rate = 1;

  Coordinates coordinates() const override { return Coordinates::flat(0); }
  void initial(Out, Out) const override {}
  void mass(double, In, Matrix&) const override {}
  bool mass_is_constant() const override { return true; }
  void force(double, In, In, Out) const override {}
  Energy energy(double, In, In) const override { return {}; }
  std::span<const std::string> markers() const override { return names_; }
  void motion(int, double t, In, In, Motion& motion) const override {
    motion.x = amplitude * std::sin(rate * t);
    motion.R.setIdentity(2, 2);
    motion.V.setZero(3);
    motion.bias.setZero(3);
    motion.V.head(2) = rate * std::cos(rate * t) * amplitude;
    motion.bias.head(2) = -rate * rate * std::sin(rate * t) * amplitude;
    motion.dofs.clear();
    motion.J.resize(3, 0);
  }

 private:
  std::vector<std::string> names_ = {"point"};
};

}  // namespace

TRAMMEL_PLUGIN(trammel::body<SwayingPoint>("swaying_point", "a marker that moves by a law of time")
                   .parameter("amplitude", &SwayingPoint::amplitude, {.unit = "m"})
                   .parameter("rate", &SwayingPoint::rate, {.unit = "rad/s"}))
