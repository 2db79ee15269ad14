// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_VIEW_H
#define HLSCM_PROGRAM_VIEW_H

#include "pictures/Canvas.h"
#include "pictures/Drawn_surface.h"

namespace hlscm {

/// A rectangle of a canvas, in pixels.
struct Panel
{
  double left, top, width, height;
};

/// A parallel projection that fits a surface into a panel.
class View
{
public:
  /// Looks at the outside of the surface from where most of it is seen. Up is z if the surface
  /// stands on its lower end in z and not in y, else y; or the other one if one looks along it.
  explicit View(const Drawn_surface& surface);

  /// The size of the picture of the surface, width over height.
  double aspect_ratio() const { return m_width / m_height; }

  /// Scales and moves so that the surface fills the panel.
  void fit_to(const Panel& panel);

  /// Enlarges the picture so that what was at a place of the canvas comes to another one.
  void magnify(double factor, double from_x, double from_y, double to_x, double to_y)
  {
    m_scale *= factor;
    m_centre_x = to_x + factor * (m_centre_x - from_x);
    m_centre_y = to_y + factor * (m_centre_y - from_y);
  }

  Canvas::Point operator()(const Vector_3& p) const
  {
    return {m_centre_x + m_scale * (dot(m_right, p) - m_x),
            m_centre_y - m_scale * (dot(m_up, p) - m_y), dot(m_toward, p)};
  }

  double pixels_per_unit() const { return m_scale; }

  /// Whether the faces are ordered clockwise seen from the outside, which is where the normals of a
  /// nearly closed surface would point to.
  bool is_inside_out() const { return m_is_inside_out; }

  const Vector_3& right() const { return m_right; }
  const Vector_3& up() const { return m_up; }
  const Vector_3& toward() const { return m_toward; } ///< from the surface to the eye

private:
  Vector_3 m_right, m_up, m_toward;
  double m_x = 0, m_y = 0, m_width = 1, m_height = 1; // of the projected surface
  bool m_is_inside_out = false;
  double m_scale = 1, m_centre_x = 0, m_centre_y = 0;
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_VIEW_H
