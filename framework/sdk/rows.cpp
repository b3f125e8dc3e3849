// Allocates the rows of joints, contacts and bodies.
#include <type_traits>

#include <trammel/body.hpp>
#include <trammel/marker.hpp>

namespace trammel {

// Clears the whole storage: stores of a compile-time size are much faster than memset.
void Rows::resize(int n, Space space, int markers) {
  const auto clear = [](auto& x, auto... size) {
    x.resize(size...);
    Eigen::Map<Eigen::Array<double, std::decay_t<decltype(x)>::MaxSizeAtCompileTime, 1>>(x.data()).setZero();
  };
  clear(g, n), clear(g_t, n), clear(gamma, n);
  for (int k = 0; k < markers; ++k) clear(H(k), n, twist_size(space));
  for (int k = markers; k < most_markers; ++k) H(k).resize(0, twist_size(space));
}

void BodyRows::resize(int n, int nv) {
  g.setZero(n);
  g_t.setZero(n);
  gamma.setZero(n);
  G.setZero(n, nv);
}

}  // namespace trammel
