// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace sateen::capture {

/// What turns the sphere.
class Stage {
 public:
  virtual ~Stage() = default;
  /// Turns to `degrees` (counter-clockwise as the camera sees it, from where the stage was at the start) and
  /// returns when it has settled. Throws Error with what the stage said and what to do.
  virtual void move_to(double degrees) = 0;
  /// Tells the stage where it stands: a resumed capture goes on from its last frame.
  virtual void stands_at(double) {}
  /// True when the stage knows the angles it moves to.
  virtual bool knows_angles() const { return true; }
};

struct GrblOptions {
  int baud = 115200;
  char axis = 'X';
  double units_per_turn =
      360;               ///< of the axis, in whatever unit the controller is set to ($100 steps per unit)
  double feed = 3600;    ///< units per minute
  bool reverse = false;  ///< the stage turns clockwise for rising coordinates
  std::chrono::milliseconds answer_timeout{3000};
  std::chrono::milliseconds move_timeout{60000};
  std::chrono::milliseconds settle{300};  ///< after standing still, for vibrations
};

/// A stepper stage behind a GRBL (1.1) controller on a serial line: G-code in, "ok", "error:N", "ALARM:N" and
/// "<Idle|...>" out. An alarm is unlocked once and the move repeated; a reset (the start-up banner in the
/// middle of a move) is told as a lost position. Throws Error when the device does not answer like GRBL.
std::unique_ptr<Stage> open_grbl_stage(const std::string& device, const GrblOptions& options);

/// A hand: `prompt` is called with what to do and returns when it is done.
std::unique_ptr<Stage> manual_stage(std::function<void(const std::string&)> prompt);

/// Something that turns by itself, once in `turn`; 0: unknown, frames follow each other as fast as the camera
/// gives them.
std::unique_ptr<Stage> continuous_stage(std::chrono::milliseconds turn);

}  // namespace sateen::capture
