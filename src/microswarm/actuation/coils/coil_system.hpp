// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "microswarm/actuation/amplifiers/amplifier_params.hpp"
#include "microswarm/actuation/coils/mpem.hpp"
#include "microswarm/actuation/coils/vfield.hpp"
#include "microswarm/actuation/coils/winding.hpp"
#include "microswarm/actuation/field/field.hpp"
#include "microswarm/config/key_locations.hpp"

namespace microswarm::actuation {

/// Three orthogonal Helmholtz pairs x, y, z around one centre. The two windings of a pair are one
/// radius apart and carry the same current.
struct HelmholtzCoils {
  static constexpr std::string_view type_name = "helmholtz";
  std::vector<double> centre{0, 0, 0};
  std::vector<double> radius{40000, 55000, 70000};
  std::vector<double> turns{100, 140, 180};
  double length = 0;
  double thickness = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.centre, um("centre", -1e8, 1e8, "Centre of the pairs, [x, y, z]."));
    visit(self.radius, um("radius", 1, 1e8, "Radii of the pairs x, y, z; also their distances."));
    visit(self.turns, plain("turns", 1e-3, 1e6, "Turns of each winding of the pairs x, y and z."));
    visit(self.length, um("length", 0, 1e8, "Length of each winding; 0: thin."));
    visit(self.thickness, um("thickness", 0, 1e8, "Outer less inner radius; 0: thin."));
  }
};

/// Six equal coils on the faces of a cube, in the order x- x+ y- y+ z- z+, each with its own
/// current [global], [gather]. A positive current produces a field towards +x, +y or +z at the
/// centre.
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
    visit(self.centre, um("centre", -1e8, 1e8, "Centre of the cube, [x, y, z]."));
    visit(self.radius, um("radius", 1, 1e8, "Radius of the middle turn."));
    visit(self.distance, um("distance", 0, 1e8, "From the centre to the middle of each coil."));
    visit(self.turns, plain("turns", 1e-3, 1e6, "Turns of each coil."));
    visit(self.length, um("length", 0, 1e8, "Length of each coil; 0: thin."));
    visit(self.thickness, um("thickness", 0, 1e8, "Outer less inner radius; 0: thin."));
  }
};

/// Arbitrary coils, listed winding by winding.
struct LoopCoils {
  static constexpr std::string_view type_name = "loops";
  std::vector<CoilParams> coils{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.coils, plain("coils", "The coils one by one.").needed());
  }
};

/// Coils calibrated as multipoles.
struct MpemCoils {
  static constexpr std::string_view type_name = "mpem";
  std::string file{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.file, plain("file", "Calibration in MPEM YAML.").needed());
  }
};

/// Coils given by one field grid each.
struct VfieldCoils {
  static constexpr std::string_view type_name = "vfield";
  std::vector<std::string> files{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.files, plain("files", "A VField grid for each coil.").needed());
  }
};

/// An actuation matrix, as fitted by a calibration: the field at a centre and, optionally, its
/// constant gradients, B(p) = (A + Σ_k G_k (p − centre)_k) I. Without them the field is the same
/// everywhere.
struct MatrixCoils {
  static constexpr std::string_view type_name = "matrix";
  std::vector<std::string> names{};
  std::vector<std::vector<double>> field{};
  std::vector<double> offset{0, 0, 0};
  std::vector<std::vector<double>> gradient{};
  std::vector<double> offset_gradient{0, 0, 0, 0, 0};
  std::vector<double> centre{0, 0, 0};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.names, plain("names", "Names of the coils.").needed());
    visit(self.field, mt_per_a("field", -1e3, 1e3,
                               "Rows Bx, By, Bz of the actuation matrix, one column a coil.")
                          .needed());
    visit(self.offset, mt("offset", -100, 100, "Field without current, [x, y, z]."));
    visit(self.gradient, t_per_m_per_a("gradient", -1e6, 1e6,
                                       "Rows dBx/dx, dBx/dy, dBx/dz, dBy/dy, dBy/dz, or none."));
    visit(self.offset_gradient,
          t_per_m("offset_gradient", -1e6, 1e6, "The same five without current."));
    visit(self.centre, um("centre", -1e8, 1e8, "Where `field` holds, [x, y, z]."));
  }
};

/// Contents of a coil system file.
struct CoilSystemParams {
  std::string name{};
  std::string id{};
  std::variant<HelmholtzCoils, CubeCoils, LoopCoils, MpemCoils, VfieldCoils, MatrixCoils> coils{};
  std::vector<AmplifierParams> amplifiers{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.name, plain("name", "Name of the system."));
    visit(self.id, plain("id", "Identity of the coils, whose heat is remembered."));
    visit(self.coils, plain("coils", "The coils, by kind.").needed());
    visit(self.amplifiers,
          plain("drives", "Amplifier and limits: one entry for all coils, or one each."));
  }
};

/// Linear map from coil currents to field and gradient at one position.
struct Actuation {
  Eigen::Matrix3Xd field{};                              ///< actuation matrix [mT/A], Eq 3 [global]
  Eigen::Matrix<double, 5, Eigen::Dynamic> gradients{};  ///< five_gradients of each coil [mT/µm/A]
  FieldGradient offset{};                                ///< at zero current [mT], [mT/µm]

  Eigen::Vector3d total_field(const Eigen::VectorXd& currents) const {
    return field * currents + offset.field;
  }
  Eigen::Matrix3d total_gradient(const Eigen::VectorXd& currents) const {
    return microswarm::actuation::gradient_matrix(gradients * currents) + offset.gradient;
  }
};

/// A coil made of current loops.
struct LoopCoil {
  std::string name{};
  std::vector<CurrentLoop> loops{};
};

/// Field of coils at a centre with its constant gradients.
struct LinearField {
  Eigen::Matrix3Xd field{};                              ///< [mT/A]
  Eigen::Matrix<double, 5, Eigen::Dynamic> gradients{};  ///< five_gradients of each coil [mT/µm/A]
};

/// A system of coils: the field of each coil and the limits of its amplifier.
class CoilSystem {
 public:
  /// Reads the files named in the parameters, relative to `folder`. InputErrors point to the
  /// locations in `keys`.
  explicit CoilSystem(const CoilSystemParams& params, const KeyLocations& keys = {},
                      const std::filesystem::path& folder = {});

  const std::string& name() const { return name_; }
  /// Identity that copies of the file keep; empty if it is not given.
  const std::string& id() const { return id_; }
  std::size_t size() const { return names_.size(); }
  const std::vector<std::string>& coil_names() const { return names_; }
  /// One entry per coil.
  const std::vector<AmplifierParams>& amplifiers() const { return amplifiers_; }
  /// Limits the current of every coil to `most` [A], the maximum of the driver.
  void limit_current(double most);
  /// Centre of the system or of its workspace [µm].
  const Eigen::Vector3d& centre() const { return centre_; }
  /// Whether the model is valid at `position`. Windings and a matrix are taken as valid everywhere.
  bool in_workspace(const Eigen::Vector3d& position) const;
  /// Actuation at a position [µm]. Throws InputError outside a measured grid.
  Actuation at(const Eigen::Vector3d& position) const;

 private:
  using Model =
      std::variant<std::vector<LoopCoil>, MpemSystem, std::vector<FieldGrid>, LinearField>;

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
  std::string id_;
  std::vector<std::string> names_;
  std::vector<AmplifierParams> amplifiers_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  FieldGradient offset_;
  Model model_;
};

/// Reads a coil system file; unknown keys are errors. Throws InputError.
CoilSystem read_coil_system(const std::filesystem::path& path);

}  // namespace microswarm::actuation
