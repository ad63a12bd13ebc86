// Switches of the model: which of the documented variants of a term is used. Not physical data: those are the stage.
#pragma once

namespace epicyclic::model {

/// Damping of a mesh when its gap is open (docs/theory/model.md, section 2).
enum class GapDamping {
  always,         ///< c delta': Eq. (27) as printed; acts through the open gap, also as a tensile force
  contact_slope,  ///< c f_w'(delta) delta': weighted by the slope of the smooth clearance
};

/// Terms with omega_c of the frame that rotates with the carrier (docs/theory/model.md, section 3).
enum class Gyroscopic {
  automatic,    ///< printed for `as_printed`, invariant where the carrier is free
  off,          ///< none
  as_printed,   ///< Eqs. (17)-(20): with a free carrier the rigid rotation diverges
  carrier_row,  ///< printed plus N M_p omega_c^2 u_c in the carrier row: not exact either
  invariant,    ///< from the Lagrangian in the planets' displacement relative to the carrier's own rotation
};

/// The centrifugal force of the planets about the stage's axis.
enum class Centrifugal {
  left_out,  ///< as in Eq. (18), whose omega_c^2 x_pi is what changes of it alone
  included,  ///< M_p omega_c^2 r_c along each planet's radius
};

struct ModelOptions {
  GapDamping gap_damping = GapDamping::always;
  Gyroscopic gyroscopic = Gyroscopic::automatic;
  double clearance_smoothing = 0;  ///< width w of the smooth clearance [b_c]; 0: exact, piecewise linear
  bool halved_tables = false;      ///< computed tables without every second row: for their error, not of the input
  Centrifugal centrifugal = Centrifugal::left_out;

  /// @throws InputError for a negative width
  void validate() const;
};

}  // namespace epicyclic::model
