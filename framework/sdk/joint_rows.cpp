#include <trammel/joint_rows.hpp>

#include <algorithm>
#include <type_traits>

#include <trammel/component.hpp>

namespace trammel {

namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// Products with an angular velocity: C(n) omega = omega x n, C(n)^T d = n x d.
template <int D>
struct Plane {  // D = 2
  static constexpr int rotations = 1;
  using Vector = Eigen::Vector2d;
  using Turn = Eigen::Matrix<double, 1, 1>;
  static Eigen::Matrix<double, 2, 1> C(const Vector& n) { return {-n.y(), n.x()}; }
};
template <int D>
struct Spatial {
  static constexpr int rotations = 3;
  using Vector = Vector3d;
  using Turn = Vector3d;
  static Matrix3d C(const Vector& n) { return Matrix3d{{0, n.z(), -n.y()}, {-n.z(), 0, n.x()}, {n.y(), -n.x(), 0}}; }
};
template <int D>
using Of = std::conditional_t<D == 2, Plane<D>, Spatial<D>>;

Matrix3d tilde(const Vector3d& a) {
  return Spatial<3>::C(a).transpose();
}

// n, e_2 and e_3 are a right-handed triad.
struct TriadAfter {
  Vector3d e_2, e_3;
};
TriadAfter triad_after(const Vector3d& n) {
  const Vector3d e_2 = n.unitOrthogonal();
  return {e_2, n.cross(e_2)};
}

}  // namespace

ReactionTangent::~ReactionTangent() = default;

Vec3 unit_axis(const Vec3& axis, const char* parameter) {
  const double length = axis.stableNorm();
  if (!(length > 0))
    throw ParameterError(parameter, "the direction has length 0; expected a direction, e.g. [1, 0, 0]");
  return axis / length;
}

Vector3d spatial_axis(const World& world, const std::optional<Vec3>& axis, const char* parameter,
                      const Vector3d& otherwise) {
  if (!axis) return otherwise;
  if (world.space == Space::planar)
    throw ParameterError(parameter, "this scene is planar, where everything turns about the plane's normal; remove it");
  return unit_axis(*axis, parameter);
}

Quaterniond unit_quaternion(const World& world, const std::vector<double>& wxyz, const char* parameter) {
  if (wxyz.empty()) return Quaterniond::Identity();
  if (world.space == Space::planar)
    throw ParameterError(parameter, "this scene is planar; give \"angle\" in its place");
  const Eigen::Map<const Vec> p(wxyz.data(), Eigen::Index(wxyz.size()));
  if (p.size() != 4 || !(p.stableNorm() > 0))
    throw ParameterError(parameter, "expected a quaternion [w, x, y, z] that is not zero");
  const Vec unit = p.stableNormalized();
  return {unit(0), unit(1), unit(2), unit(3)};
}

// Index of a new law in laws_; -1 for the constant 0.
int JointRows::follow(TimeFunction p, const Vector3d& axis) {
  if (p.is_constant() && p(0) == 0) return -1;
  laws_.push_back({std::move(p), axis});
  return int(laws_.size()) - 1;
}

TimeFunction::Jet JointRows::law(int place, double t) const {
  return place < 0 ? TimeFunction::Jet{} : laws_[std::size_t(place)].p.jet(t);
}

JointRows& JointRows::same_point() {
  same_point_ = true;
  return *this;
}

JointRows& JointRows::offset(const Vec3& n, TimeFunction p) {
  rows_.push_back(Offset{n, follow(std::move(p))});
  return *this;
}

JointRows& JointRows::across(const Vec3& n) {
  if (space_ == Space::planar) return offset(Eigen::Vector2d(-n(1), n(0)));
  const auto [e_2, e_3] = triad_after(n);
  return offset(e_2).offset(e_3);
}

JointRows& JointRows::dot(const Vector3d& a, const Vector3d& b) {
  rows_.push_back(Dot{a, b, -1});
  return *this;
}

JointRows& JointRows::parallel(const Vector3d& n_A, const Vector3d& n_B) {
  if (space_ == Space::planar) return *this;
  const auto [e_2, e_3] = triad_after(n_A);
  return dot(e_2, n_B).dot(e_3, n_B);
}

JointRows& JointRows::angle(const Vec3& n, const Quaterniond& Q, TimeFunction phi) {
  if (space_ == Space::planar) {
    rows_.push_back(Angle{follow(std::move(phi))});
    return *this;
  }
  const auto [e_2, e_3] = triad_after(n);
  // a . b = e_2 . turn(delta) (-e_3) = sin(delta)
  rows_.push_back(Dot{e_2, Q.conjugate() * Vector3d(-e_3), follow(std::move(phi), n)});
  return *this;
}

JointRows& JointRows::orientation(const Vec3& n, const Quaterniond& Q, TimeFunction phi) {
  angle(n, Q, phi);
  if (space_ == Space::planar) return *this;
  const auto [e_2, e_3] = triad_after(n);
  const Vector3d n_B = Q.conjugate() * Vector3d(n);
  return dot(e_2, n_B).dot(e_3, n_B);
}

int JointRows::count() const {
  return int(rows_.size()) + (same_point_ ? dimension(space_) : 0);
}

// Linear if the axes do not turn and no law of time acts.
bool JointRows::linear() const {
  return std::all_of(laws_.begin(), laws_.end(), [](const Law& law) { return law.p.is_constant(); });
}

bool JointRows::needs_orientation(int marker) const {
  return std::any_of(rows_.begin(), rows_.end(), [&](const Row& row) {
    return marker == 0 || !std::holds_alternative<Offset>(row);  // an offset's direction is fixed in A
  });
}

// The rows of one joint at one instant.
template <int D>
struct JointRows::Evaluation {
  static constexpr int turns = Of<D>::rotations;
  using Vector = typename Of<D>::Vector;
  using Turn = typename Of<D>::Turn;

  Evaluation(const JointRows& of, double time, const Motion& of_A, const Motion& of_B)
      : joint(of),
        t(time),
        A(of_A),
        B(of_B),
        d(of_B.x - of_A.x),
        d_dot(of_B.V.head<D>() - of_A.V.head<D>()),
        omega(of_A.V.tail<turns>()) {}

  void place_same_point(Rows& r) const {
    r.g.template head<D>() = d;
    r.H_A.template topLeftCorner<D, D>().diagonal().setConstant(-1);
    r.H_B.template topLeftCorner<D, D>().diagonal().setConstant(1);
  }

  void place(const Offset& row, int& i, Rows& r) const {
    const Vector n = A.R * row.n;
    const auto p = joint.law(row.law, t);
    const Vector n_dot = Of<D>::C(n) * omega;
    r.g(i) = n.dot(d) - p.value;
    r.g_t(i) = -p.rate;
    r.gamma(i) = -2 * n_dot.dot(d_dot) - (Of<D>::C(n_dot) * omega).dot(d) + p.second;
    r.H_A.row(i).template head<D>() = -n.transpose();
    r.H_A.row(i).template tail<turns>() = (Of<D>::C(n).transpose() * d).transpose();
    r.H_B.row(i).template head<D>() = n.transpose();
    ++i;
  }

  void place(const Dot& row, int& i, Rows& r) const {
    if constexpr (D == 3) {
      if (row.law < 0) return place_dot(A.R * row.a, omega, B.R * row.b, i, r);
      const Turned a = turned(row);
      place_dot(a.a, omega + a.omega, B.R * row.b, i, r);
      const Vector3d c = r.H_A.row(i - 1).template tail<3>();
      r.g_t(i - 1) = a.omega.dot(c);
      r.gamma(i - 1) -= a.alpha.dot(c);
    }
  }

  void place_dot(const Vector3d& a, const Vector3d& omega_a, const Vector3d& b, int& i, Rows& r) const {
    const Vector3d c = a.cross(b), omega_b = B.V.tail<3>();
    const Vector3d c_dot = omega_a.cross(a).cross(b) + a.cross(omega_b.cross(b));
    r.g(i) = a.dot(b);
    r.gamma(i) = -(omega_a - omega_b).dot(c_dot);
    r.H_A.row(i).template tail<3>() = c.transpose();
    r.H_B.row(i).template tail<3>() = -c.transpose();
    ++i;
  }

  void place(const Angle& row, int& i, Rows& r) const {
    const auto phi = joint.law(row.law, t);
    r.g(i) = B.angle - A.angle - phi.value;
    r.g_t(i) = -phi.rate;
    r.gamma(i) = phi.second;
    r.H_A(i, D) = -1;
    r.H_B(i, D) = 1;
    ++i;
  }

  void vary(const Angle&, const double*& lambda, PairTangent&) const { ++lambda; }

  // W_A = lambda (-n, n x d), W_B = lambda (n, 0)
  void vary(const Offset& row, const double*& lambda, PairTangent& K) const {
    const double l = *lambda++;
    const Vector n = A.R * row.n;
    const auto C = Of<D>::C(n);
    K.AA.topRightCorner<D, turns>() -= l * C;
    K.BA.topRightCorner<D, turns>() += l * C;
    K.AA.bottomLeftCorner<turns, D>() -= l * C.transpose();
    K.AB.bottomLeftCorner<turns, D>() += l * C.transpose();
    K.AA.bottomRightCorner<turns, turns>() -= l * Of<D>::C(d).transpose() * C;
  }

  // W_A = lambda (0, a x b) = -W_B
  void vary(const Dot& row, const double*& lambda, PairTangent& K) const {
    const double l = *lambda++;
    if constexpr (D == 3) {
      const Matrix3d a = tilde(row.law < 0 ? Vector3d(A.R * row.a) : turned(row).a), b = tilde(B.R * row.b);
      const Matrix3d by_A = l * b * a, by_B = -l * a * b;
      K.AA.bottomRightCorner<3, 3>() += by_A;
      K.BA.bottomRightCorner<3, 3>() -= by_A;
      K.AB.bottomRightCorner<3, 3>() += by_B;
      K.BB.bottomRightCorner<3, 3>() -= by_B;
    }
  }

  // a of A rotated by a law phi(t) about n. omega = phi' n and alpha: angular velocity and acceleration relative to A.
  struct Turned {
    Vector3d a, omega, alpha;
  };
  Turned turned(const Dot& row) const {
    const auto phi = joint.law(row.law, t);
    const Vector3d& axis = joint.laws_[std::size_t(row.law)].axis;
    const Vector3d n = A.R * axis, n_rate = phi.rate * n;
    return {A.R * (Eigen::AngleAxisd(phi.value, axis) * row.a), n_rate, phi.second * n + omega.cross(n_rate)};
  }

  const JointRows& joint;
  double t;
  const Motion &A, &B;
  Vector d, d_dot;
  Turn omega;
};

void JointRows::rows(double t, const Motion& A, const Motion& B, Rows& rows) const {
  int i = same_point_ ? dimension(space_) : 0;
  const auto place_all = [&](const auto& evaluation) {
    if (same_point_) evaluation.place_same_point(rows);
    for (const Row& row : rows_) std::visit([&](const auto& one) { evaluation.place(one, i, rows); }, row);
  };
  if (space_ == Space::planar)
    place_all(Evaluation<2>(*this, t, A, B));
  else
    place_all(Evaluation<3>(*this, t, A, B));
}

void JointRows::add_reaction_tangent(double t, const Motion& A, const Motion& B, const Vec6& lambda,
                                     PairTangent& K) const {
  const double* each = lambda.data() + (same_point_ ? dimension(space_) : 0);
  const auto vary_all = [&](const auto& evaluation) {
    for (const Row& row : rows_) std::visit([&](const auto& one) { evaluation.vary(one, each, K); }, row);
  };
  if (space_ == Space::planar)
    vary_all(Evaluation<2>(*this, t, A, B));
  else
    vary_all(Evaluation<3>(*this, t, A, B));
}

Quaterniond smallest_rotation(const Vector3d& from, const Vector3d& to) {
  const Vector3d a = from.normalized(), b = to.normalized();
  const double twice_w = (a + b).norm();  // 2 cos(angle/2)
  constexpr double nearly_opposite = 1e-6;
  if (twice_w < nearly_opposite) {  // half a turn about a normal of a, then the small rotation that is left
    const Vector3d n = a.unitOrthogonal();
    return smallest_rotation(-a, b) * Quaterniond(0, n.x(), n.y(), n.z());
  }
  const Vector3d part = a.cross(b) / twice_w;
  return Quaterniond(twice_w / 2, part.x(), part.y(), part.z()).normalized();
}

}  // namespace trammel
