// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "microswarm/actuation/coils/mpem.hpp"
#include "microswarm/actuation/coils/vfield.hpp"
#include "microswarm/actuation/coils/winding.hpp"
#include "microswarm/actuation/field/drive_params.hpp"
#include "microswarm/actuation/field/field.hpp"
#include "microswarm/config/key_locations.hpp"

namespace microswarm {

/// Three orthogonal Helmholtz pairs x, y, z around one centre: the two windings of a pair are as
/// far apart as their radius and carry one current.
struct HelmholtzCoils {
  static constexpr std::string_view type_name = "helmholtz";
  std::vector<double> centre{0, 0, 0};
  std::vector<double> radius{40000, 55000, 70000};
  std::vector<double> turns{100, 140, 180};
  double length = 0;
  double thickness = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.centre, {"centre", Unit::um, {-1e8, 1e8}, "Centre of the pairs, [x, y, z]."});
    visit(self.radius,
          {"radius", Unit::um, {1, 1e8}, "Radii of the pairs x, y, z; also their distances."});
    visit(self.turns,
          {"turns", Unit::none, {1e-3, 1e6}, "Turns of each winding of the pairs x, y and z."});
    visit(self.length, {"length", Unit::um, {0, 1e8}, "Length of each winding; 0: thin."});
    visit(self.thickness, {"thickness", Unit::um, {0, 1e8}, "Outer less inner radius; 0: thin."});
  }
};

/// Six equal coils on the faces of a cube, x- x+ y- y+ z- z+, each with its own current [global],
/// [gather]. A positive current makes a field towards +x, +y or +z at the centre.
struct CubeCoils {
  static constexpr std::string_view type_name = "cube";
  std::vector<double> centre{0, 0, 0};
  double radius = 40000;
  double distance = 60000;
  double turns = 200;
  double length = 0;
  double thickness = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.centre, {"centre", Unit::um, {-1e8, 1e8}, "Centre of the cube, [x, y, z]."});
    visit(self.radius, {"radius", Unit::um, {1, 1e8}, "Radius of the middle turn."});
    visit(self.distance,
          {"distance", Unit::um, {0, 1e8}, "From the centre to the middle of each coil."});
    visit(self.turns, {"turns", Unit::none, {1e-3, 1e6}, "Turns of each coil."});
    visit(self.length, {"length", Unit::um, {0, 1e8}, "Length of each coil; 0: thin."});
    visit(self.thickness, {"thickness", Unit::um, {0, 1e8}, "Outer less inner radius; 0: thin."});
  }
};

/// Any coils, winding by winding.
struct LoopCoils {
  static constexpr std::string_view type_name = "loops";
  std::vector<CoilParams> coils;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.coils, {"coils", Unit::none, {}, "The coils one by one.", true});
  }
};

/// A calibration as multipoles.
struct MpemCoils {
  static constexpr std::string_view type_name = "mpem";
  std::string file;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.file, {"file", Unit::none, {}, "Calibration in MPEM YAML.", true});
  }
};

/// A grid of fields for each coil.
struct VfieldCoils {
  static constexpr std::string_view type_name = "vfield";
  std::vector<std::string> files;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.files, {"files", Unit::none, {}, "A VField grid for each coil.", true});
  }
};

/// One actuation matrix for the whole workspace, as a calibration fits it: no gradients.
struct MatrixCoils {
  static constexpr std::string_view type_name = "matrix";
  std::vector<std::string> names;
  std::vector<std::vector<double>> field;
  std::vector<double> offset{0, 0, 0};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.names, {"names", Unit::none, {}, "Names of the coils.", true});
    visit(self.field, {"field",
                       Unit::mt_per_a,
                       {-1e6, 1e6},
                       "Rows Bx, By, Bz of the actuation matrix, one column a coil.",
                       true});
    visit(self.offset, {"offset", Unit::mt, {-1e6, 1e6}, "Field without current, [x, y, z]."});
  }
};

/// A file of a coil system.
struct CoilSystemParams {
  std::string name;
  std::variant<HelmholtzCoils, CubeCoils, LoopCoils, MpemCoils, VfieldCoils, MatrixCoils> coils;
  std::vector<DriveParams> drives;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.name, {"name", Unit::none, {}, "Name of the system."});
    visit(self.coils, {"coils", Unit::none, {}, "The coils, by kind.", true});
    visit(
        self.drives,
        {"drives", Unit::none, {}, "Amplifier and limits: one entry for all coils, or one each."});
  }
};

/// What the coils make of currents at one place.
struct Actuation {
  Eigen::Matrix3Xd field;                              ///< actuation matrix [mT/A], Eq 3 [global]
  Eigen::Matrix<double, 5, Eigen::Dynamic> gradients;  ///< five_gradients of each [mT/µm/A]
  FieldGradient offset;                                ///< without current [mT], [mT/µm]

  Eigen::Vector3d field_of(const Eigen::VectorXd& currents) const {
    return field * currents + offset.field;
  }
  Eigen::Matrix3d gradient_of(const Eigen::VectorXd& currents) const {
    return microswarm::gradient_of(gradients * currents) + offset.gradient;
  }
};

/// A coil as loops.
struct LoopCoil {
  std::string name;
  std::vector<CurrentLoop> loops;
};

/// A system of coils: what field each makes where, and what their amplifiers bear.
class CoilSystem {
 public:
  /// Reads the files that the parameters name, beside `folder`. Throws InputError where `keys`
  /// stand.
  explicit CoilSystem(const CoilSystemParams& params, const KeyLocations& keys = {},
                      const std::filesystem::path& folder = {});

  const std::string& name() const { return name_; }
  std::size_t size() const { return names_.size(); }
  const std::vector<std::string>& coil_names() const { return names_; }
  /// One for each coil.
  const std::vector<DriveParams>& drives() const { return drives_; }
  /// No coil gets more than this from now on [A], as its driver cannot give more.
  void limit_current(double most);
  /// The middle of the system or of its workspace [µm].
  const Eigen::Vector3d& centre() const { return centre_; }
  /// Whether the model is known to hold there; windings and a matrix know no bounds.
  bool in_workspace(const Eigen::Vector3d& place) const;
  /// What the currents make at a place [µm]. Throws InputError outside of a measured grid.
  Actuation at(const Eigen::Vector3d& place) const;

 private:
  using Model =
      std::variant<std::vector<LoopCoil>, MpemSystem, std::vector<FieldGrid>, Eigen::Matrix3Xd>;

  void add(const HelmholtzCoils& params, Issues& issues);
  void add(const CubeCoils& params, Issues& issues);
  void add(const LoopCoils& params, Issues& issues);
  void add(const MpemCoils& params, Issues& issues);
  void add(const VfieldCoils& params, Issues& issues);
  void add(const MatrixCoils& params, Issues& issues);
  void check_names(Issues& issues) const;
  std::optional<std::string> beside(const std::string& file, std::string_view key,
                                    Issues& issues) const;

  std::filesystem::path folder_;
  std::string name_;
  std::vector<std::string> names_;
  std::vector<DriveParams> drives_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  FieldGradient offset_;
  Model model_;
};

/// Reads a file of a coil system, strictly. Throws InputError.
CoilSystem read_coil_system(const std::filesystem::path& path);

}  // namespace microswarm
