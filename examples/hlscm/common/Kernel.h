// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_KERNEL_H
#define HLSCM_PROGRAM_KERNEL_H

#include <CGAL/Simple_cartesian.h>

namespace hlscm {

using Kernel = CGAL::Simple_cartesian<double>;

} // namespace hlscm

#endif // HLSCM_PROGRAM_KERNEL_H
