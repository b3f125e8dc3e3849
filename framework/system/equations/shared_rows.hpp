// Rows of contacts that are implied by others at the point, and the forces of closed contacts that follow:
//
//     g_implied = K g_basis + a combination of the joints' rows
//
// K depends on the configuration. It is constant if the dependence follows from the geometry of one body, such as the
// feet of a table; it changes if bodies that touch at one point turn against each other. K is tested with one
// pseudo-random motion that the joints permit. The part of the joints' rows is formed at every configuration, but only
// where joints rub: their loads are those of the shared forces, of equal springs while they slide.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "system/equations/impulse_response.hpp"

namespace trammel::numerics {
class BlockSigns;
}

namespace trammel::model {

class SharedRowsAtPoint {
 public:
  SharedRowsAtPoint(Point& at, ContactsAtPoint& contacts, JointFriction& friction, RowsAtPoint& rows,
                    ImpulseResponse& response)
      : at_(at), contacts_(contacts), friction_(friction), rows_(rows), response_(response) {}

  void lay_out();        // for the contacts' modes
  void evaluate_rows();  // with the shares if W depends on them
  bool follow();         // updates K and the shares at this point; true if some have changed

  double force_along(ContactDirection d, const Vec& lambda);   // [N] of a closed contact that does not slide
  double spring_force(int contact, const Vec& lambda);         // [N] of an idle contact if it shared as a spring
  const ContactLoads& prepared(int group, const Vec& lambda);  // with the resultants of a group
  Mat moved_with_sliding(int group);                           // ContactLoads::solve_with_sliding
  // Flips the sign of a group's block if the rows of its carrying contacts have a negative determinant in the basis.
  // The sign changes where these rows come to depend on each other: the shares pass infinity there, the forces do not.
  void change_signs(numerics::BlockSigns& signs);
  double leverage(int group);        // AssembledSystem::leverage
  double off_span(int group);        // AssembledSystem::off_span
  Vec reactions(const Vec& lambda);  // AssembledSystem::reactions

 private:
  struct Rate {
    double sum = 0, terms = 0;  // terms: sum of the absolute values of the terms
    double free = 0;            // the same for a motion of this size which no joint holds
  };
  Rate rate_by(ContactDirection d, const Vec& some, const Vec& sizes);
  struct Off {
    double of_terms = 0, of_free = 0;  // parts of the rate of an implied row that K leaves
  };
  Off off_span(const SharedRows& group, const Vec& some, const Vec& sizes);
  void renew(int group);
  const Mat& part_of_joints(int group);  // C^T: held rows x implied
  void share_with_joints();
  using LoadsOfJoints = std::map<int, double>;  // of joints at rest in a group, by contact [N]
  LoadsOfJoints loads_as_springs(int group, const Vec& lambda);
  LoadsOfJoints loads_as_solved(int group, const Vec& lambda);
  double load_of_joint(int contact, const Vec& lambda);
  ContactLoads::Bounds bounds(int contact, const Vec& lambda, const LoadsOfJoints& of_joints);
  ContactLoads::Held solve(int group, const Vec& lambda, const LoadsOfJoints& of_joints);
  const ContactLoads& solved(int group, const Vec& lambda);  // with the forces of its contacts

  // The system's point at which `loads` has the forces of a group. Contacts ask for theirs one after the other.
  struct SolvedAt {
    long long point = -1, configuration = -1;
    Vec lambda;
    LoadsOfJoints of_joints;
    bool is(const Point& at, const Vec& multipliers) const {
      return point == at.number && configuration == at.configuration && lambda.size() == multipliers.size() &&
             lambda == multipliers;
    }
  };
  Point& at_;
  ContactsAtPoint& contacts_;
  JointFriction& friction_;
  RowsAtPoint& rows_;
  ImpulseResponse& response_;
  std::vector<SolvedAt> solved_at_;                 // by group
  std::vector<double> off_span_;                    // by group
  std::vector<std::optional<Mat>> part_of_joints_;  // by group, at that configuration
  long long followed_at_ = -1;                      // the configuration at which K and the shares were last updated
};

}  // namespace trammel::model
