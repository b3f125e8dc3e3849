// Coordinates q that remain under linear conditions on the displacements: u = B q.
//
// u are the three displacements of every control point (3 n). Each condition sum c_k u_k = 0 expresses the component
// with the largest coefficient (the last of equals) by the others, so conditions along the axes just delete columns,
// and q are always components of u themselves. A condition that follows from those before it, to the accuracy of
// its coefficients, is ignored.
#pragma once

#include <vector>

#include <trammel/types.hpp>

namespace trammel::plate {

struct Term {
  int component;
  double factor;
};

class Elimination {
 public:
  explicit Elimination(int components) : relation_(std::size_t(components)), held_(std::size_t(components), false) {}

  // `known_to`: accuracy of the coefficients, relative to the largest one.
  void hold(std::vector<Term> condition, double known_to = 1e-12);
  void hold(int component) { hold({{component, 1}}); }
  void finish();  // no conditions may follow

  int coordinates() const { return int(kept_.size()); }
  const std::vector<int>& kept() const { return kept_; }  // the component of u that each coordinate is
  // u of a component as a sum over coordinates.
  const std::vector<Term>& terms(int component) const { return relation_[std::size_t(component)]; }

  void expand(In q, Eigen::Ref<Vec> u) const;   // u = B q
  void restrict(const Vec& f, Out of_q) const;  // += B^T f

 private:
  void substitute(std::vector<Term>& sum) const;
  std::vector<std::vector<Term>> relation_;
  std::vector<bool> held_;
  std::vector<int> kept_;
};

}  // namespace trammel::plate
