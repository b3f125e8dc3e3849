// Bodies with a surface: the nearest point is nearest, and its motion is that of the surface.
#include <fmt/format.h>

#include <cmath>

#include "testing/body_under_test.hpp"
#include "testing/kit/components/components.hpp"

namespace trammel::kit {

namespace {

constexpr ClaimsOf surface_claim{"body.surface-", "trammel/body.hpp"};

std::string has_no_surface(const Subject& s) {
  return s.offers<Surface>() ? "" : "it does not offer Surface";
}

struct Nearest {
  Eigen::Vector2d parameters;
  Vec3 point, normal;
};

// Points at some height over the surface, above points of the surface itself.
struct Above {
  TriedBody tried;
  const Surface& surface;
  std::vector<BodyAt> states;

  explicit Above(const Subject& s)
      : tried(s.maker<Body>(), {.q = 1e-3, .v = 0.1, .count = 2, .seed = s.seed}),
        surface(dynamic_cast<const Surface&>(*tried.body)),
        states(tried.at()) {}
  Nearest nearest(const BodyAt& at, const Vec3& x) const {
    Nearest n;
    surface.nearest(at.t, at.q, x, n.parameters, n.point, n.normal);
    return n;
  }
  // A place of the surface to look from: under the centre of its markers, or of the origin.
  Vec3 start(const BodyAt& at) const {
    Vec3 sum = Vec3::Zero(3);
    const std::size_t count = tried.body->markers().size();
    for (std::size_t i = 0; i < count; ++i) sum += tried.motion(i, at).x;
    return nearest(at, count ? Vec3(sum / double(count)) : sum).point;
  }
  void for_each(const Subject& s, const std::function<void(const BodyAt&, const Vec3& x, const Nearest&)>& look) const {
    std::mt19937 random = s.random(61);
    for (const BodyAt& at : states) {
      const Nearest base = nearest(at, start(at));
      for (int i = 0; i < 4; ++i) {
        const double height = 0.05 * between(random, 0.2, 1) * (i % 2 ? 1 : -1);
        const Vec3 x = base.point + height * base.normal;
        look(at, x, nearest(at, x));
      }
    }
  }
};

Report nearest_is_perpendicular(const Subject& s) {
  return compare("x - point is along the normal, of length 1", [&](Comparison& c) {
    const Above above(s);
    above.for_each(s, [&](const BodyAt&, const Vec3& x, const Nearest& n) {
      c.within(n.normal.norm(), 1, 1e-12, "length of the normal");
      const Vec3 d = x - n.point;
      c.within((d - d.dot(n.normal) * n.normal).norm(), 0, 1e-7 * (d.norm() + 1e-3),
               "part of x - point across the normal");
    });
  });
}

Report nearest_is_nearest(const Subject& s) {
  return compare("no neighbour of the nearest point is nearer", [&](Comparison& c) {
    const Above above(s);
    above.for_each(s, [&](const BodyAt& at, const Vec3& x, const Nearest& n) {
      const double distance = (x - n.point).norm();
      Motion m;
      for (const double du : {-1e-3, 1e-3})
        for (const double dv : {-1e-3, 1e-3}) {
          const Eigen::Vector2d beside = (n.parameters + Eigen::Vector2d(du, dv)).cwiseMax(0).cwiseMin(1);
          above.surface.motion_at(beside, at.t, at.q, at.v, m);
          c.holds((x - m.x).norm() >= distance * (1 - 1e-9),
                  fmt::format("{:.12g} m at ({}, {}), {:.12g} m at the nearest", (x - m.x).norm(), beside[0], beside[1],
                              distance));
        }
    });
  });
}

Report motion_is_that_of_the_point(const Subject& s) {
  return compare("motion_at is the motion of that point", [&](Comparison& c) {
    const Above above(s);
    above.for_each(s, [&](const BodyAt& at, const Vec3&, const Nearest& n) {
      Motion m;
      above.surface.motion_at(n.parameters, at.t, at.q, at.v, m);
      c.within(Vec(m.x), Vec(n.point), 1e-9 * (1 + n.point.norm()), "place");
      const Difference rate = difference(
          [&](double d) {
            Motion moved;
            const BodyAt then = above.tried.along(at, Vec::Zero(at.v.size()), d);
            above.surface.motion_at(n.parameters, then.t, then.q, then.v, moved);
            return Vec(moved.x);
          },
          1e-3);
      c.derivative(Vec(m.V.head(3)), rate, "velocity");
      Vec V = m.J.topRows(3) * above.tried.of_dofs(m, at.v);
      c.within(V, Vec(m.V.head(3)), 1e-10 * (1 + m.V.norm()), "J v");
    });
  });
}

Report has_a_thickness(const Subject& s) {
  return compare("half of the thickness is not negative", [&](Comparison& c) {
    const double half = dynamic_cast<const Surface&>(*s.maker<Body>()()).half_thickness();
    c.holds(half >= 0 && std::isfinite(half), fmt::format("half_thickness() = {:.6g} m", half));
  });
}

}  // namespace

Checks surface_checks() {
  const char* const nearest = "Nearest point on a body's surface, for contact.";
  return {
      {surface_claim("normal-points-to-the-point", "The nearest point lies under the point, along the normal.",
                     "(x - p) x n = 0, |n| = 1", nearest),
       Level::quick, nearest_is_perpendicular, has_no_surface},
      {surface_claim("nearest-is-nearest", "No point beside the nearest one is nearer.", "|x - p(u, v)| >= |x - p*|",
                     nearest),
       Level::quick, nearest_is_nearest, has_no_surface},
      {surface_claim("motion-is-that-of-the-point", "The motion at parameters (u, v) is that of the surface's point.",
                     "dx/dt = V = J v", "The point is given by surface parameters (u, v)."),
       Level::quick, motion_is_that_of_the_point, has_no_surface},
      {surface_claim("has-a-thickness", "The faces lie on both sides of the surface.", "half thickness >= 0",
                     "Distance from this surface to the body's faces on both sides [m]."),
       Level::quick, has_a_thickness, has_no_surface}};
}

}  // namespace trammel::kit
