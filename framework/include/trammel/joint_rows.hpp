// The rows that joints consist of, planar and spatial, exact in g, H, g_t, gamma and in the derivative of their
// reaction.
//
//     same_point         g = x_B - x_A                                      2 or 3 rows, always the first
//     offset(n, p)       g = n . (x_B - x_A) - p(t)                         n fixed in A; p may be a law of time
//     dot(a, b)          g = a . b                                          a fixed in A, b in B; spatial
//     angle(n, Q, phi)   g = sin(angle of B against A about n - phi(t))     spatial, |g| < 1
//                        g = theta_B - theta_A - phi(t)                     planar
//     orientation        three such rows: R_B = R_A turn(n, phi(t)) Q;      planar: the angle row alone
//
// Vectors fixed in a marker are unit vectors in its axes. A law of time can rotate `dot` rows: then a is fixed in a
// frame that is rotated by phi(t) about n against A. Its angular velocity is omega_A + n phi', its angular acceleration
// alpha_A + n phi'' + omega_A x n phi'.
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
  JointRows& across(const Vec3& n);  // offset rows in the directions perpendicular to n: one planar, two spatial
  JointRows& dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b);
  JointRows& parallel(const Eigen::Vector3d& n_A, const Eigen::Vector3d& n_B);  // two dot rows; planar: no rows
  // In the plane n and Q are not used.
  JointRows& angle(const Vec3& n, const Eigen::Quaterniond& Q, TimeFunction phi);
  JointRows& orientation(const Vec3& n, const Eigen::Quaterniond& Q, TimeFunction phi);

  int count() const;
  bool linear() const;                       // see LinearRows
  bool needs_orientation(int marker) const;  // see NeedsOrientation
  void rows(double t, const Motion& A, const Motion& B, Rows& rows) const;
  // Adds d(H^T lambda)/d(twists of the markers) to K; see ReactionTangent.
  void add_reaction_tangent(double t, const Motion& A, const Motion& B, const Vec6& lambda, PairTangent& K) const;

 private:
  // Most rows have no law of time. Laws are stored separately (law: index into laws_, or -1) to save memory.
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
    Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // of a dot row: the axis of the rotation p
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

// A joint that consists of such rows only; made_of() defines it completely.
class RowJoint : public Joint, public ReactionTangent, public LinearRows, public NeedsOrientation {
 public:
  virtual JointRows made_of(const World&) const = 0;  // may refuse parameters with a ParameterError

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

// The unit vector along `axis`; throws a ParameterError for `parameter` if `axis` is zero.
Vec3 unit_axis(const Vec3& axis, const char* parameter);
// Spatial parameters that joints share: an axis (`otherwise` if it is missing), refused in planar scenes; and a unit
// quaternion from [w, x, y, z] (empty: the identity).
Eigen::Vector3d spatial_axis(const World&, const std::optional<Vec3>& axis, const char* parameter,
                             const Eigen::Vector3d& otherwise = Eigen::Vector3d::UnitZ());
Eigen::Quaterniond unit_quaternion(const World&, const std::vector<double>& wxyz, const char* parameter);
// The smallest rotation that turns the direction `from` to `to`; half a turn about some normal if they are opposite, to
// a millionth. As Eigen's FromTwoVectors, whose singular value decomposition takes 10 s to compile.
Eigen::Quaterniond smallest_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace trammel
