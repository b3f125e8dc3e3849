// The rows of bodies, joints and contacts at the point: g, g_dot, gamma, G and W; dense, or in the blocks of many
// bodies.
#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "system/equations/body_blocks.hpp"
#include "system/equations/constant_rows.hpp"
#include "system/point/contacts.hpp"
#include "system/point/joint_friction.hpp"

namespace trammel::model {

class RowsAtPoint {
 public:
  RowsAtPoint(Point& at, ContactsAtPoint& contacts, JointFriction& friction, BodyBlocks* blocks);

  // For the contacts' modes: the first `held` of `count` rows are bilateral in impacts.
  void lay_out(int count, int held);
  int count() const { return count_; }
  int held() const { return held_; }

  bool evaluate();  // false: they were evaluated already
  void forget() { fresh_ = false; }
  const Vec& g() const { return g_; }
  const Vec& g_dot() const { return g_dot_; }
  const Vec& gamma() const { return gamma_; }
  const Mat& G() const { return G_; }  // not in blocks
  const Mat& W() const { return W_; }  // not in blocks; only if coupled
  // sliding friction depends on the force of a row, so W differs from G
  bool coupled() const { return coupled_; }
  void couple();                                           // forms W
  void unload_bearings();                                  // W with unloaded bearings
  bool load_bearings(const Vec& lambda);                   // W at these multipliers; false: W^T lambda did not change
  void add_times(double c, const Vec& x, Vec& rc) const;   // rc += c G x
  void add_force(double c, const Vec& y, Vec& r) const;    // r += c G^T y
  void add_reaction(double c, const Vec& lambda, Vec& r);  // r += c W^T lambda
  Eigen::SparseMatrix<double, Eigen::RowMajor> sparse() const;  // G, without entries that are 0
  double rank_tolerance() const;                                // from the violation of the rows (rank_tolerance_at)

  CallSite find_not_finite();  // among joints

 private:
  void order_joints();
  void evaluate_constant_rows();
  void place_constant_rows();
  void evaluate_own_rows(const BodyEntry& body);
  void evaluate_contact(int i);
  // Rows [first, first + n) of r between these markers become the rows from `row` on.
  void place(const Rows& r, const Slots& slots, const Seen& motions, Eigen::Index first, Eigen::Index n, int row);
  void add_sliding(int contact, const Tangential& ratio);  // its friction, to W
  void add_to_reaction(int slot, int row, const Mat6& H);

  Point& at_;
  ContactsAtPoint& contacts_;
  JointFriction& friction_;
  BodyBlocks* blocks_;                        // null: dense
  std::vector<std::size_t> joint_order_;      // sorted by their first bodies, for cache locality
  std::vector<std::size_t> constant_joints_;  // rows linear in the coordinates; not in joint_order_
  std::vector<std::size_t> constrained_;      // bodies with their own rows
  ConstantRows constant_rows_;
  bool constant_rows_placed_ = false;  // in `blocks_`
  int count_ = 0, held_ = 0;
  bool fresh_ = false, coupled_ = false;
  Vec g_, g_dot_, gamma_;
  Mat G_, W_;
  Rows rows_;  // of one joint
  BodyRows own_rows_;
};

}  // namespace trammel::model
