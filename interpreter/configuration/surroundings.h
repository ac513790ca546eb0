#pragma once

#include <optional>
#include <string>
#include <vector>

#include "interpreter/configuration/path_patterns.h"
#include "interpreter/configuration/text_place.h"
#include "interpreter/geometry/vectors.h"

/// What surrounds a program, as files describe it. make_scene makes bodies of it. Lengths in mm.
namespace isocnc::configuration {

/// Rows of numbers, all of the length that their key wants.
using NumberRows = std::vector<std::vector<double>>;

/// Rows with a name chosen by the author.
struct NamedRows {
  std::string name;
  NumberRows rows;
};

/// An STL file.
struct MeshFile {
  std::string name;        ///< Path from the folder of the file that names it.
  std::string key;         ///< Path of the key that names it, such as `setups[0].target.mesh`.
  DescriptionPlace place;  ///< Of its value.
};

struct DescribedCylinder {
  std::optional<geometry::Vec3> at;    ///< Center of the foot; always set in a valid file.
  std::optional<geometry::Vec3> axis;  ///< From the foot; without it, Z. Of any length but 0.
  double height = 0;
  double diameter = 0;
};

/// One of a box, a cylinder and a mesh.
struct DescribedShape {
  std::optional<NumberRows> box;  ///< Two corners: the lower one, the upper one.
  std::optional<DescribedCylinder> cylinder;
  std::optional<MeshFile> mesh;
  std::optional<geometry::Vec3> at;  ///< Shift of the shape.
};

/// A fixture, a stock, or a body of the machine.
struct DescribedBody {
  std::string name;
  std::string on = "machine";  ///< Of a body of the machine: the part that carries it.
  DescribedShape shape;
  DescriptionPlace place;
};

struct DescribedSpoilboard {
  double top = 0;
  double allow = 0;                ///< How far cuts may go into it.
  std::optional<NumberRows> area;  ///< Two corners in X and Y; without it, as large as is useful.
  DescriptionPlace place;
};

struct DescribedTarget {
  std::optional<MeshFile> mesh;  ///< Always set in a valid file.
  std::optional<geometry::Vec3> at;
  double tolerance = 0;
  DescriptionPlace place;
};

/// What stands around the programs of certain paths, or around one program.
struct DescribedSetup {
  std::vector<std::string> paths;  ///< Empty for the setup of one program.
  PathPatterns patterns;           ///< Parsed form of `paths`.
  std::string frame = "workpiece";
  std::optional<DescribedBody> stock;
  std::optional<DescribedSpoilboard> spoilboard;
  std::vector<DescribedBody> fixtures;
  std::optional<DescribedTarget> target;
  std::optional<double> resolution;  ///< Of the stock.
  double clearance = 2;
};

}  // namespace isocnc::configuration
