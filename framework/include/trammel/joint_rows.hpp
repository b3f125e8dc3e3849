// The rows that joints are made of, planar and spatial, exact in g, H, g_t, gamma and in the derivative of their reaction.
//
//     same_point         g = x_B - x_A                                      2 or 3 rows, the first
//     offset(n, p)       g = n . (x_B - x_A) - p(t)                         n fixed in A; p may be a law of time
//     dot(a, b)          g = a . b                                          a fixed in A, b in B; spatial
//     angle(n, Q, phi)   g = sin(angle of B against A about n - phi(t))     spatial, |g| < 1;   planar theta_B - theta_A - phi
//     orientation        three such rows: R_B = R_A turn(n, phi(t)) Q;      planar the angle alone
//
// Vectors fixed in a marker are in its axes, here of unit length. `dot` rows can be turned by a law of time: a is then fixed
// in A turned by phi(t) about n, whose angular velocity is omega_A + n phi' and whose angular acceleration has
// n phi'' + omega_A x n phi' besides alpha_A.
//
//     struct Spherical : RowJoint {
//       JointRows made_of(const World& w) const override { return JointRows(w.space).same_point(); }
//     };
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include <Eigen/Geometry>

#include <trammel/joint.hpp>
#include <trammel/linear_rows.hpp>
#include <trammel/needs_orientation.hpp>
#include <trammel/time_function.hpp>

namespace trammel {

class JointRows {
 public:
  explicit JointRows(Space space = Space::planar) : space_(space) {}

  JointRows& same_point();
  JointRows& offset(const Vec3& n, TimeFunction p = {});
  JointRows& across(const Vec3& n);  // offset rows along all directions perpendicular to n: one planar, two spatial
  JointRows& dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b);
  JointRows& parallel(const Eigen::Vector3d& n_A, const Eigen::Vector3d& n_B);  // two dot rows; planar: none are needed
  // In the plane n and Q are not looked at.
  JointRows& angle(const Vec3& n, const Eigen::Quaterniond& Q, TimeFunction phi);
  JointRows& orientation(const Vec3& n, const Eigen::Quaterniond& Q, TimeFunction phi);

  int count() const;
  bool linear() const;                       // see LinearRows
  bool needs_orientation(int marker) const;  // see NeedsOrientation
  void rows(double t, const Motion& A, const Motion& B, Rows& rows) const;
  // K += d(H^T lambda)/d(twists of the markers), see ReactionTangent.
  void add_reaction_tangent(double t, const Motion& A, const Motion& B, const Vec6& lambda, PairTangent& K) const;

 private:
  // Most rows follow no law: theirs are kept apart (law: its place, or -1), so that those of many joints take less memory.
  struct Offset {
    Vec3 n;
    int law;
  };
  struct Dot {
    Eigen::Vector3d a, b;
    int law;
  };
  struct Angle {
    int law;
  };
  using Row = std::variant<Offset, Dot, Angle>;
  struct Law {
    TimeFunction p;
    Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // of a dot row: what p turns A about
  };

  template <int D>
  struct Evaluation;

  int follow(TimeFunction p, const Eigen::Vector3d& axis = Eigen::Vector3d::UnitZ());
  TimeFunction::Jet law(int place, double t) const;

  Space space_;
  bool same_point_ = false;
  std::vector<Row> rows_;  // after those of same_point
  std::vector<Law> laws_;
};

// A joint that is such rows and nothing else: saying which makes it whole.
class RowJoint : public Joint, public ReactionTangent, public LinearRows, public NeedsOrientation {
 public:
  virtual JointRows made_of(const World&) const = 0;  // from the parameters, which it may refuse

  void prepare(const World& world) override { list_ = made_of(world); }
  int row_count(Space) const override { return list_.count(); }
  bool linear() const final { return list_.linear(); }
  bool needs_orientation(int marker) const final { return list_.needs_orientation(marker); }
  void rows(double t, const Motion& A, const Motion& B, Rows& rows) const final { list_.rows(t, A, B, rows); }
  void add_reaction_tangent(double t, const Motion& A, const Motion& B, const Vec6& lambda,
                            PairTangent& K) const override {
    list_.add_reaction_tangent(t, A, B, lambda, K);
  }

 private:
  JointRows list_;
};

// A unit vector along `axis` of the scene's dimension; refuses the zero vector in the name of `parameter`.
Vec3 unit_axis(const Vec3& axis, const char* parameter);
// Parameters that joints share, in space: an axis (`otherwise` if left out), refused in the plane where it means nothing;
// and a unit quaternion from [w, x, y, z] (none: no turn).
Eigen::Vector3d spatial_axis(const World&, const std::optional<Vec3>& axis, const char* parameter,
                             const Eigen::Vector3d& otherwise = Eigen::Vector3d::UnitZ());
Eigen::Quaterniond unit_quaternion(const World&, const std::vector<double>& wxyz, const char* parameter);

}  // namespace trammel
