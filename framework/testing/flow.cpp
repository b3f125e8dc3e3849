#include "testing/flow.hpp"

#include <vector>

namespace trammel {
namespace {

struct Point {
  Vec q, v;
};

Point slope(System& s, double t, Point y) {
  s.normalise(y.q);
  Point rate;
  Vec lambda;
  s.rate(y.q, y.v, rate.q);
  s.move_to(t, y.q, y.v);
  s.accelerate({}, rate.v, lambda);
  return rate;
}

Point plus(const Point& y, double h, const Point& rate) {
  return {y.q + h * rate.q, y.v + h * rate.v};
}

Point midpoint_rule(System& s, const State& now, double h, int n) {
  Point before{now.q, now.v}, y = plus(before, h / n, slope(s, now.t, before));
  for (int i = 1; i < n; ++i) {
    Point next = plus(before, 2 * h / n, slope(s, now.t + i * h / n, y));
    before = std::move(y);
    y = std::move(next);
  }
  return y;
}

}  // namespace

State exact_flow(System& s, const State& now, double h) {
  constexpr int columns = 9;
  std::vector<Point> row;  // extrapolated from j + 1 rules, the last one included
  for (int k = 0; k < columns; ++k) {
    Point next = midpoint_rule(s, now, h, 2 * (k + 1));
    for (int j = 0; j < k; ++j) {
      const double ratio = double(k + 1) / (k - j);
      const Point difference{next.q - row[j].q, next.v - row[j].v};
      std::swap(row[j], next);
      next = plus(row[j], 1 / (ratio * ratio - 1), difference);
    }
    row.push_back(std::move(next));
  }
  State end{now.t + h, row.back().q, row.back().v, {}, {}};
  s.normalise(end.q);
  s.move_to(end.t, end.q, end.v);
  s.accelerate({}, end.a, end.lambda);
  return end;
}

}  // namespace trammel
