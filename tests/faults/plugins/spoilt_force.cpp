// A falling point mass whose force, from a given time on, is not a number, reads from address 0, overflows the stack,
// or aborts.
#include <array>
#include <cstdlib>
#include <limits>
#include <string>

#include <trammel/body.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

// Needs all the stack there is; the page is volatile so that no compiler sees through it.
double endless(int depth) {
  volatile char page[4096];
  page[depth % 4096] = 1;
  return page[depth % 4096] == 1 ? endless(depth + 1) + page[0] : 0;
}

double spoil(const std::string& how, int depth) {
  if (how == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (how == "abort") std::abort();
  if (how == "stack") return endless(depth);
  double* volatile nowhere = nullptr;
  return *nowhere;
}

struct SpoiltForce : Body {
  double from = 0.5;  // [s]
  std::string how = "nan";

  void prepare(const World& world) override {
    gravity_ = world.gravity;
    space_ = world.space;
  }
  Coordinates coordinates() const override { return Coordinates::flat(dimension(space_)); }
  void initial(Out q, Out v) const override {
    q.setZero();
    v.setZero();
  }
  void mass(double, In, Matrix& M) const override {
    for (int i = 0; i < dimension(space_); ++i) M.add(i, i, 1.0);
  }
  void force(double t, In, In, Out f) const override {
    f += gravity_;
    if (t >= from) f[0] = spoil(how, 1);
  }
  Energy energy(double, In q, In v) const override { return {0.5 * v.squaredNorm(), -gravity_.dot(q), 0}; }
  std::span<const std::string> markers() const override { return markers_; }
  void motion(int, double, In q, In v, Motion& motion) const override {
    const int n = dimension(space_);
    motion.x = q;
    motion.R = Mat3::Identity(n, n);
    motion.angle = 0;
    motion.V = Vec6::Zero(twist_size(space_));
    motion.V.head(n) = v;
    motion.bias = Vec6::Zero(twist_size(space_));
    motion.dofs.resize(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) motion.dofs[static_cast<std::size_t>(i)] = i;
    motion.J = Jac::Identity(twist_size(space_), n);
  }

 private:
  Vec3 gravity_;
  Space space_ = Space::planar;
  std::array<std::string, 1> markers_ = {"point"};
};

}  // namespace

TRAMMEL_PLUGIN(body<SpoiltForce>("spoilt_force", "point mass whose force goes wrong from a given time on")
                   .source("none")
                   .parameter("from", &SpoiltForce::from, {.unit = "s", .doc = "when it begins"})
                   .parameter("how", &SpoiltForce::how, {.doc = "nan, memory, stack, abort"}))
