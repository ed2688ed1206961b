// The contact forces of the last step.
#pragma once

#include <span>
#include <vector>

#include "stepper/contact.hpp"

namespace supernormal::stepper {

class Memory {
 public:
  /// Gives each contact the impulse in `time` (s) of the nearest contact that the same two geoms had, in the frame of the first
  /// body that moves. There the manifold points of a body that slides are the same ones, and the point of a body that rolls is the
  /// nearest.
  void recall(System& system, double time);

  /// Before keep(): leaves the forces of two geoms as they are, because their bodies sleep.
  void leave(dGeomID geom1, const Body& body1, dGeomID geom2, const Body& body2);

  /// Forgets the forces on a body: another one may come to have its address, and its geoms'.
  void forget(dBodyID body);

  /// Keeps the forces that act in the present sub-step of `time` (s): those that were recalled, and `part` of what they changed by.
  void keep(System& system, double time, double part);

  /// Appends the forces as numbers, with the places of their geoms among `geoms`.
  void save(std::span<const dGeomID> geoms, std::vector<double>& numbers) const;

  /// Takes saved forces in place of its own. False, and no change, if they are none.
  bool load(std::span<const dGeomID> geoms, std::span<const double> numbers);

 private:
  // Of two geoms, that with the lower address is the first. The addresses decide only who is who, so they change no digit.
  struct Key {
    const void* low = nullptr;
    const void* high = nullptr;
    bool is_swapped = false;  // whether the second geom is the first here
  };
  struct Force {
    Key key;
    dBodyID body1 = nullptr, body2 = nullptr;
    int order = 0;                         // among the contacts of the step
    Vector3 place_low, place_high;         // m, in the frames of the bodies, when the step began
    double normal = 0;                     // N
    Vector3 tangential = Vector3::Zero();  // N, world frame, on the body of the geom `low`
    Vector3 torque = Vector3::Zero();      // N m, world frame, on the same body
    Vector3 centring = Vector3::Zero();    // m/s, of a contact that moves
    bool is_taken = false;
    bool is_left = false;

    /// As if the other geom had the lower address.
    void swap_sides() {
      place_low.swap(place_high);
      for (Vector3* const vector : {&tangential, &torque, &centring}) *vector = -*vector;
    }
  };
  static Key key_of(dGeomID geom1, const Body& body1, dGeomID geom2, const Body& body2);
  static bool is_before(const Key& a, const Key& b);
  void sort();
  std::span<Force> forces_of(const Key& key);
  void recall_pair(System& system, const Pair& pair, double time);

  std::vector<Force> forces_;  // sorted by their keys
  std::vector<Force> next_;    // of the contacts of this step
};

}  // namespace supernormal::stepper
