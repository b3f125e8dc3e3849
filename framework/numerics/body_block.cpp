#include "numerics/body_block.hpp"

namespace trammel::numerics {

void add_rows_times(const std::vector<BodyBlock>& bodies, double c, const Vec& x, Vec& rc) {
  for (const BodyBlock& body : bodies)
    for (std::size_t i = 0; i < body.rows.size() && body.rows[i] < rc.size(); ++i)
      rc(body.rows[i]) += c * body.Gt.col(Eigen::Index(i)).dot(x.segment(body.v0, body.Gt.rows()));
}

namespace {

void add_columns(const BodyBlock& body, const Mat& columns, double c, const Vec& y, Vec& r) {
  for (std::size_t i = 0; i < body.rows.size() && body.rows[i] < y.size(); ++i)
    r.segment(body.v0, columns.rows()) += c * y(body.rows[i]) * columns.col(Eigen::Index(i));
}

}  // namespace

void add_rows_force(const std::vector<BodyBlock>& bodies, double c, const Vec& y, Vec& r) {
  for (const BodyBlock& body : bodies) add_columns(body, body.Gt, c, y, r);
}

void add_reaction(const std::vector<BodyBlock>& bodies, double c, const Vec& y, Vec& r) {
  for (const BodyBlock& body : bodies) add_columns(body, body.Wt, c, y, r);
}

void add_mass_times(const std::vector<BodyBlock>& bodies, double c, const Vec& a, Vec& r) {
  for (const BodyBlock& body : bodies)
    r.segment(body.v0, body.M.rows()).noalias() += c * (body.M * a.segment(body.v0, body.M.rows()));
}

}  // namespace trammel::numerics
