#pragma once

#include <string>

#include "reports/common/json_view.hpp"

/// The tables that a results folder offers to other programs. Columns and their order are a
/// contract: new ones go to the end. Numbers are the shortest text that reads back as the same
/// double; what is absent is an empty cell. Rings count from 1, at the wheel.
namespace crossgrain::reports {

/// engine,packing,method,field,ring,r_m,r_tilde,mean,stderr,n_eff,unit,stderr_kind,dof,
/// from_rotation,to_rotation,prepared_rotations
/// packing is an index, its stderr_kind "within_run", or "all", the mean over packings, "packings".
std::string profilesCsv(const Json& results);

/// engine,packing,quantity,ring,low,high,density,stderr,low_2,high_2,stderr_kind
/// One row per cell that holds anything; packing and stderr_kind as in profiles.csv, ring "all" for
/// the whole cell (the joint distribution: within one d of the wheel), low_2 and high_2 of joint
/// ones. What lies beyond the bins is one row without edges; its density is
/// its share.
std::string distributionsCsv(const Json& results);

/// engine,packing,t_s,wheel_torque,outer_pressure,kinetic_energy,coordination,max_overlap,
/// sliding_fraction, then further series that the results hold, by name, those of an energy
/// ledger (energy_…) last.
std::string seriesCsv(const Json& results);

/// engine,packing,regime,wheel_contacts,wheel_slip,shear_share,inertial_number,blocked_share,
/// from_rotation,to_rotation,prepared_rotations,reason
/// One row per finished run; regime "flowing", "blocked", "collisional" or, where the run does not
/// show enough, empty. Rotations averaged count from the hand-over, prepared_rotations were before.
std::string regimesCsv(const Json& results);

/// engine,packing,quantity,verdict,change,half_width,excluded,from_rotation,to_rotation,
/// prepared_rotations
/// One row per run and watched series, packing "all" for the engine's mean over packings; changes
/// over the averaged time, in units of the mean.
std::string steadinessCsv(const Json& results);

/// a,b,field,ring,difference,stderr,low,high,margin,verdict,detects,within_share,packings,
/// more_packings,more_rotations,regimes_differ
/// ring "all" is the verdict on the field. regimes_differ counts the packings on which the two are
/// in different regimes.
std::string agreementCsv(const Json& results);

/// engine,effect,time_ratio,field,ring,change,stderr, then r_tilde,reference,unit,resolved,
/// p_adjusted,smallest_resolvable,family_level,packings,stderr_kind,time_ratio_stderr,step_s,
/// contacts_per_step,precision,status,reason
/// One row per field and ring; a leg that has none is one row with its status.
std::string effectsCsv(const Json& results);

/// engine,method,field,r_m,width_over_d,mean,stderr,unit
std::string revCsv(const Json& results);

/// method,field,near_d,width_over_d,difference: near which width the method comes closest to
/// slicing, and the root mean square of what is then between them, in units of slicing's.
std::string revMeetingsCsv(const Json& results);

}  // namespace crossgrain::reports
