// Changes of contacts seen at one instant.
#pragma once

#include <algorithm>
#include <vector>

namespace trammel::simulate {

// By contact.
struct ContactChanges {
  std::vector<int> struck;    // open Restitution contacts whose gap fell through 0
  std::vector<int> released;  // closed Restitution contacts whose force fell through 0
  std::vector<int> unloaded;  // those among them whose group has lost what it could spare
  std::vector<int> toggled;   // ContactForce: force on or off
  std::vector<int> yielded;   // sticking contacts whose friction reached its bound
  std::vector<int> stopped;   // sliding contacts whose slip reached 0
  bool leaning = false;       // other rows in g are to hold the same contacts: these have become nearly dependent, or
                              // contacts share with more others than before (they touched at one point)
  bool locked = false;        // sliding contacts have no finite forces from here on (rule 8)
  double raised = 0;          // friction then counts as larger by this part: the distance of the state from that point
  bool only_leaning() const {
    ContactChanges others = *this;
    others.leaning = false;
    return leaning && others.empty();
  }
  bool only_unloaded() const {
    ContactChanges others = *this;
    others.unloaded.clear(), others.released.clear();
    return !unloaded.empty() && released == unloaded && others.empty();
  }
  bool empty() const {
    return struck.empty() && released.empty() && toggled.empty() && yielded.empty() && stopped.empty() && !leaning &&
           !locked;
  }
  void clear() {
    struck.clear(), released.clear(), unloaded.clear(), toggled.clear(), yielded.clear(), stopped.clear();
    leaning = locked = false, raised = 0;
  }
};

inline bool contains(const std::vector<int>& contacts, int i) {
  return std::find(contacts.begin(), contacts.end(), i) != contacts.end();
}

}  // namespace trammel::simulate
