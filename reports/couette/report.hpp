#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "reports/common/pages.hpp"
#include "reports/common/pictures.hpp"
#include "results/compare.hpp"
#include "results/rev.hpp"

/// What comparisons, averages of snapshots and studies of ring widths are written as.
namespace crossgrain::reports {

std::string comparePage(const CompareResults& results, const Illustrations& shown);
std::string averagePage(const CompareResults& results, const Illustrations& shown);
std::string revPage(const RevResults& results, const Illustrations& shown);

/// Every plot of a comparison that there are data for. Names of figures: overview; profile_FIELD
/// (profile_azimuthal_velocity_log for its log axis); check_1, check_2, …; series_NAME;
/// distribution_velocities, distribution_joint, distribution_directions,
/// distribution_contacts.
std::vector<Figure> compareFigures(const CompareResults& results);

/// Plots of fields against ring width: rev_FIELD.
std::vector<Figure> revFigures(const RevResults& results);

/// Two per engine, of its first run that has a picture: where disks started (originsDrawing) and
/// forces. All are on one scale, of lengths and, of the first engine that has any, of forces
/// (widestForce).
std::vector<Picture> comparePictures(const CompareResults& results);

/// engine,packing,method,field,ring,r_m,r_tilde,mean,stderr,n_eff,unit,stderr_kind,dof,
/// from_rotation,to_rotation,prepared_rotations; of an assembly also x_m,y_m,from_s,to_s: the bin's
/// centre and the averaged time
/// packing is an index, its stderr_kind "within_run", or "all", the mean over packings, "packings".
std::string profilesCsv(const CompareResults& results);

/// engine,packing,quantity,ring,low,high,density,stderr,low_2,high_2,stderr_kind
/// One row per cell that holds anything; packing and stderr_kind as in profiles.csv, ring "all" for
/// the whole cell (the joint distribution: within one d of the wheel), low_2 and high_2 of joint
/// ones. What lies beyond the bins is one row without edges; its density is
/// its share.
std::string distributionsCsv(const CompareResults& results);

/// engine,packing,t_s,wheel_torque,outer_pressure,kinetic_energy,coordination,max_overlap,
/// sliding_fraction, then further series that the results hold, by name, those of an energy
/// ledger (energy_…) last.
std::string seriesCsv(const CompareResults& results);

/// engine,packing,regime,wheel_contacts,wheel_slip,shear_share,inertial_number,blocked_share,
/// from_rotation,to_rotation,prepared_rotations,reason
/// One row per finished run; regime "flowing", "blocked", "collisional" or, where the run does not
/// show enough, empty. Rotations averaged count from the hand-over, prepared_rotations were before.
std::string regimesCsv(const CompareResults& results);

/// engine,packing,quantity,verdict,change,half_width,excluded,from_rotation,to_rotation,
/// prepared_rotations
/// One row per run and watched series, packing "all" for the engine's mean over packings; changes
/// over the averaged time, in units of the mean.
std::string steadinessCsv(const CompareResults& results);

/// The verdicts; columns in reports/README.md. regimes_differ counts the packings on which the two
/// are in different regimes.
std::string endpointsCsv(const CompareResults& results);

/// Ring by ring where differences are, without a verdict.
std::string agreementCsv(const CompareResults& results);

/// engine,method,field,r_m,width_over_d,mean,stderr,unit
std::string revCsv(const RevResults& results);

/// method,field,near_d,width_over_d,difference: near which width the method comes closest to
/// slicing, and the root mean square of what is then between them, in units of slicing's.
std::string revMeetingsCsv(const RevResults& results);

}  // namespace crossgrain::reports
