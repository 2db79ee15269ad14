// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_FIGURES_NUMBERS_H
#define HLSCM_FIGURES_NUMBERS_H

#include <cstdio>
#include <string>

namespace figures {

// Three digits.
inline std::string number(double x)
{
  char text[40];
  std::snprintf(text, sizeof text, x >= 1000. ? "%.0f" : "%.3g", x);
  return text;
}

// With a comma after the thousands.
inline std::string count(std::size_t n)
{
  std::string text = std::to_string(n);
  for(int i = int(text.size()) - 3; i > 0; i -= 3)
    text.insert(std::size_t(i), ",");
  return text;
}

} // namespace figures

#endif // HLSCM_FIGURES_NUMBERS_H
