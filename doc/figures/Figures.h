// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_FIGURES_FIGURES_H
#define HLSCM_FIGURES_FIGURES_H

#include "Chart.h"

#include <filesystem>
#include <string>

namespace figures {

// Each draws one figure into the file and returns its caption, with what was measured.
std::string draw_bump_figure(const std::filesystem::path& file);
std::string draw_monogrid_figure(const Chart& chart, const std::filesystem::path& file);
std::string draw_levels_figure(const Chart& chart, const std::filesystem::path& file);
std::string draw_checker_figure(const Chart& chart, const std::filesystem::path& file);
std::string draw_signal_figure(const Chart& chart, const std::filesystem::path& file);

} // namespace figures

#endif // HLSCM_FIGURES_FIGURES_H
