#pragma once

#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "reports/common/pages.hpp"
#include "results/scale.hpp"

namespace crossgrain::reports {

std::string scalePage(const ScaleResults& results, const Illustrations& shown);

/// scale_time: ns per disk and step against disks, a curve for each engine and number of workers;
/// scale_efficiency: strong and weak efficiency against disks; scale_memory: bytes per disk.
std::vector<Figure> scaleFiguresOf(const ScaleResults& results);

/// A row per engine, size and number of workers:
/// engine,disks,workers,workers_are,status,step_s,spread,ns_per_disk,strong,weak,ratio,
/// memory_bytes,bytes_per_disk,contacts_per_step,steps,repetitions,dt_s,precision,measured,differs,reason
std::string scaleCsv(const ScaleResults& results);

/// The same for people, aligned; what is absent is a dash. Each line ended.
std::string scaleText(const ScaleResults& results);

}  // namespace crossgrain::reports
