#include "modes/mode_shapes.hpp"

#include <fmt/format.h>

#include "system/markers/numeric_derivative.hpp"

namespace trammel::simulate {
namespace {

// Step of the differences that move an outline. Three digits suffice for a drawing.
constexpr double drawn = 1e-6;

class Shapes {
 public:
  Shapes(model::AssembledSystem& system, const State& state)
      : system_(system), state_(state), dim_(dimension(system.model().world.space)) {
    system_.move_to(state.t, state.q, state.v);
    text_ = "mode,point";
    for (const char* part : {"", "_re", "_im"})
      for (int i = 0; i < dim_; ++i) text_ += fmt::format(",{}{}", "xyz"[i], part);
    text_ += '\n';
  }

  void add(int number, const Mode& mode) {
    const Vec re = mode.x.real(), im = mode.x.imag();
    for (std::size_t b = 0; b < system_.model().bodies.size(); ++b) {
      const model::BodyEntry& body = system_.model().bodies[b];
      if (body.nv == 0) continue;
      const Vec own_re = re.segment(body.v0, body.nv), own_im = im.segment(body.v0, body.nv);
      markers(number, int(b), own_re, own_im);
      if (body.drawn) outline(number, body, own_re, own_im);
    }
  }
  const std::string& text() const { return text_; }

 private:
  void markers(int number, int body, const Vec& re, const Vec& im) {
    const model::BodyEntry& entry = system_.model().bodies[std::size_t(body)];
    const auto names = entry.body->markers();
    Motion m;
    for (std::size_t i = 0; i < names.size(); ++i) {
      entry.body->motion(int(i), state_.t, state_.q.segment(entry.q0, entry.nq), state_.v.segment(entry.v0, entry.nv),
                         m);
      Vec by_re = Vec::Zero(m.J.rows()), by_im = by_re;
      for (std::size_t j = 0; j < m.dofs.size(); ++j) {
        by_re += m.J.col(Eigen::Index(j)) * re(m.dofs[j]);
        by_im += m.J.col(Eigen::Index(j)) * im(m.dofs[j]);
      }
      row(number, fmt::format("{}.{}", entry.name, names[i]), m.x, by_re.head(dim_), by_im.head(dim_));
    }
  }

  void outline(int number, const model::BodyEntry& entry, const Vec& re, const Vec& im) {
    const Vec q = state_.q.segment(entry.q0, entry.nq);
    Mat at, by_re, by_im;
    entry.drawn->shape(state_.t, q, at);
    moved_outline(entry, q, re, by_re);
    moved_outline(entry, q, im, by_im);
    for (Eigen::Index j = 0; j < at.cols(); ++j)
      row(number, fmt::format("{}:{}", entry.name, j), at.col(j), by_re.col(j), by_im.col(j));
  }

  void moved_outline(const model::BodyEntry& entry, const Vec& q, const Vec& dq, Mat& by) const {
    Vec moved;
    Mat behind;
    model::retract_body(entry, q, drawn * dq, moved);
    entry.drawn->shape(state_.t, moved, by);
    model::retract_body(entry, q, -drawn * dq, moved);
    entry.drawn->shape(state_.t, moved, behind);
    by = (by - behind) / (2 * drawn);
  }

  template <class X, class U, class W>
  void row(int number, const std::string& point, const X& x, const U& re, const W& im) {
    text_ += fmt::format("{},{}", number, point);
    for (int i = 0; i < dim_; ++i) text_ += fmt::format(",{:.9g}", x(i));
    for (int i = 0; i < dim_; ++i) text_ += fmt::format(",{:.9g}", re(i));
    for (int i = 0; i < dim_; ++i) text_ += fmt::format(",{:.9g}", im(i));
    text_ += '\n';
  }

  model::AssembledSystem& system_;
  const State& state_;
  int dim_;
  std::string text_;
};

}  // namespace

std::string shapes_csv(model::AssembledSystem& system, const State& state, const std::vector<Mode>& modes) {
  Shapes shapes(system, state);
  for (std::size_t i = 0; i < modes.size(); ++i) shapes.add(int(i) + 1, modes[i]);
  return shapes.text();
}

}  // namespace trammel::simulate
