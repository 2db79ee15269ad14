// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_PROGRAM_ERROR_H
#define HLSCM_PROGRAM_PROGRAM_ERROR_H

#include <stdexcept>
#include <string>

namespace hlscm {

/// One sentence for the user: which file, what is wrong with which element, and the remedy.
class Program_error : public std::runtime_error
{
public:
  Program_error(const std::string& file, const std::string& what_is_wrong_and_remedy)
    : std::runtime_error(file + ": " + what_is_wrong_and_remedy)
  {}
};

/// Thrown where a stage notices that the user asked to stop.
struct Cancelled
{};

} // namespace hlscm

#endif // HLSCM_PROGRAM_PROGRAM_ERROR_H
