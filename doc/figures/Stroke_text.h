// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_FIGURES_STROKE_TEXT_H
#define HLSCM_FIGURES_STROKE_TEXT_H

#include "pictures/Canvas.h"

#include <string>

namespace figures {

// The strokes of a character: points (x, y) as pairs of digits, x from 0 to 4, y from 0 (below) to
// 6; a blank separates strokes. Only what labels need: capitals, digits.
inline const char* strokes(char c)
{
  switch(c) {
  case 'A': return "002640 1333";
  case 'B': return "000636454433 0333424130 0030";
  case 'C': return "4536160501103041";
  case 'D': return "00063645413000";
  case 'E': return "46060040 0333";
  case 'F': return "460600 0333";
  case 'G': return "45361605011030414323";
  case 'H': return "0006 4046 0343";
  case 'I': return "2026";
  case 'L': return "060040";
  case 'M': return "0006234640";
  case 'N': return "00064046";
  case 'O': return "100105163645413010";
  case 'R': return "0006364544330333 2340";
  case 'S': return "453616050413334241301001";
  case 'T': return "0646 2620";
  case '0': return "100105163645413010";
  case '1': return "0426 2620";
  case '2': return "05163645440040";
  case '3': return "05163645443323 334241301001";
  case '4': return "3036024242";
  case '5': return "460603334241301001";
  case '6': return "453616050110304142330302";
  case '7': return "064610";
  case '8': return "1304051636454433130201103041423313";
  case '9': return "0110304145361605041343";
  default: return "";
  }
}

// Writes `text` with capitals of `height` pixels whose lower left corner is (x, y); above all else.
inline void write_text(hlscm::Canvas& canvas, double x, double y, double height,
                       const std::string& text)
{
  constexpr hlscm::Colour ink{0.15, 0.15, 0.17};
  const double unit = height / 6., thickness = height / 8.;
  for(const char c : text) {
    hlscm::Canvas::Point last{0., 0., 0.};
    bool is_drawing = false;
    for(const char* s = strokes(c); *s != 0;) {
      if(*s == ' ') {
        is_drawing = false;
        ++s;
        continue;
      }
      const hlscm::Canvas::Point p{x + unit * (s[0] - '0'), y - unit * (s[1] - '0'), 1e6};
      if(is_drawing)
        canvas.draw_segment(last, p, thickness, ink);
      canvas.draw_disk(p, thickness / 2., ink);
      last = p;
      is_drawing = true;
      s += 2;
    }
    x += (c == ' ' ? 3.5 : 5.5) * unit;
  }
}

} // namespace figures

#endif // HLSCM_FIGURES_STROKE_TEXT_H
