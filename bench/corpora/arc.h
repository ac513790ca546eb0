#pragma once

#include "bench/corpora/random.h"

namespace isocnc::bench {

/// A point of an arc plane, in micrometers.
struct Point {
  int x = 0;
  int y = 0;

  friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
  friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
  friend Point operator*(int factor, Point a) { return {factor * a.x, factor * a.y}; }
  friend bool operator==(Point a, Point b) { return a.x == b.x && a.y == b.y; }
};

/// An arc whose start, end and center are whole micrometers and lie exactly on one circle of a whole radius.
struct Arc {
  Point end;
  Point center;
  int radius = 0;
};

/// A spoke of the circle of radius 65 that ends on whole coordinates: 65^2 is the sum of two squares in several ways,
/// so there are 36 of them.
Point random_spoke(Random& random);

/// An arc from `start`, of 1.3 to 19.5 mm radius, that ends elsewhere and within `reach` of the origin in x and y.
Arc random_arc(Random& random, Point start, int reach);

/// The value after a step, which turns round at `reach` from the origin.
inline int walk(int value, int step, int reach) {
  const int next = value + step;
  return next > reach || next < -reach ? value - step : next;
}

}  // namespace isocnc::bench
