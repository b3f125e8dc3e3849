#include <trammel/methods/alpha_method.hpp>

namespace trammel {

void AlphaMethod::set(const Weights& weights, Formulation formulation) {
  w_ = weights;
  newmark.formulation = formulation;
  error_.set(w_.alpha_m, w_.alpha_f, w_.beta, w_.gamma, formulation == Formulation::stabilised);
}

void AlphaMethod::restart(const State& now) {
  A_ = now.a;
  a_ = now.a;
  error_.restart(now);
}

Outcome AlphaMethod::step(System& s, const State& now, double h, State& next) {
  // a_{n+1} = known + share A_{n+1}
  const double share = (1 - w_.alpha_f) / (1 - w_.alpha_m);
  known_ = (w_.alpha_f * A_ - w_.alpha_m * a_) / (1 - w_.alpha_m);
  newmark.dq = h * now.v + h * h * ((0.5 - w_.beta) * a_ + w_.beta * known_);
  newmark.v = now.v + h * ((1 - w_.gamma) * a_ + w_.gamma * known_);
  const double c_q = w_.beta * h * h * share, c_v = w_.gamma * h * share;
  newmark.begin(s, now, h, c_q, c_v, next);
  newmark.extrapolate(now, error_.a_before(), h / error_.h_before(), next);
  while (newmark.iterating()) {
    newmark.move(s, now, next);
    r_ = -s.f();
    s.add_reaction(1, next.lambda, r_);
    s.add_mass_times(1, next.a, r_);
    newmark.correct(s, {1, c_v, c_q}, r_, next);
  }
  return newmark.finish(s, now, next);
}

void AlphaMethod::accept(const State& next) {
  a_ = ((1 - w_.alpha_f) * next.a + w_.alpha_f * A_ - w_.alpha_m * a_) / (1 - w_.alpha_m);
  A_ = next.a;
  error_.accept(next);
}

void AlphaMethod::archive(Archive& archive) {
  archive("now_algorithmic_a", a_);
  archive("now_a", A_);
  error_.archive(archive);
}

}  // namespace trammel
