// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_BORDER_CONTACTS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_BORDER_CONTACTS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Border_pieces.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Page_check.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Lengths on pages, in texels.
struct Contact_sizes
{
  Plane_vector_d page;      // width and height
  Plane_vector_d low, high; // the corners of what charts may cover
  double gap;  // wanted between charts along rows or columns, whichever is more
  double unit; // the smallest length that counts
};

// A point of a border that is near another one, or beyond the sides of a page: the gap is that of their
// places along the normal.
struct Contact
{
  static constexpr std::uint32_t no_sample = std::uint32_t(-1);
  std::uint32_t sample, other; // at which the piece with the other point begins, or `no_sample`
  double part;                 // of the way along that piece
  Plane_vector_d normal;
  double gap, wanted;
  double length; // of the border that it stands for
};

// The borders of bent charts, by points along them, and where they come too near to each other, to
// themselves, or to the sides of the page.
class Border_contacts
{
public:
  typedef Plane_vector_d Vector;

  explicit Border_contacts(const Contact_sizes& sizes) : m_sizes(sizes), m_pieces(sizes.page, reach()) {}

  // Adds a loop of a chart's border, which has the chart on its left, at rest.
  void add_loop(std::uint32_t chart, std::uint32_t page, const std::vector<std::uint32_t>& loop,
                const std::vector<Chart_shape::Point_2>& uv, const Control_net& net);

  // Wants larger gaps from now on at samples within the reach of some places.
  void widen(const std::vector<Page_place>& places, double more)
  {
    for(std::size_t i = 0; i < m_samples.size(); ++i) {
      const auto is_near = [&](const Page_place& p) {
        const Vector way = m_places[i] - Vector{p.place[0], p.place[1]};
        return p.page == m_samples[i].page && way.squared_length() < reach() * reach();
      };
      if(std::any_of(places.begin(), places.end(), is_near))
        m_samples[i].more += more;
    }
  }

  void widen_nothing()
  {
    for(Sample& sample : m_samples)
      sample.more = 0.;
  }

  // Sets the gaps that are wanted by how borders run with these control points: gaps are wanted along rows
  // or columns, whichever is more, so that those across diagonals are the widest.
  void set_gaps(const std::vector<Vector>& points);

  // Finds the contacts of charts with these control points.
  void find(const std::vector<Vector>& points);

  // Those of the last `find()`.
  const std::vector<Contact>& contacts() const { return m_contacts; }

  // Those of the control points in the change of a contact's gap, along its normal.
  Control_weights weights(const Contact& contact) const
  {
    Control_weights result = m_samples[contact.sample].weights;
    if(contact.other != Contact::no_sample) {
      const Sample& there = m_samples[contact.other];
      add(there.weights, contact.part - 1., result);
      add(m_samples[there.next].weights, -contact.part, result);
    }
    return result;
  }

  // By how much the largest gap is too small, after `find()`.
  double worst() const
  {
    double result = 0.;
    for(const Contact& c : m_contacts)
      result = (std::max)(result, c.wanted - c.gap);
    return result;
  }

  // The longest way of a point of a border from where it was in the last `find()`.
  double longest_way(const std::vector<Vector>& points) const
  {
    std::vector<double> longest(Blocked_execution::number_of_blocks(m_samples.size(), block), 0.);
    Blocked_execution::blocked_for(m_samples.size(), block, [&](std::size_t begin, std::size_t end) {
      double& result = longest[begin / block];
      for(std::size_t i = begin; i < end; ++i)
        result = (std::max)(result, (sum_of(m_samples[i].weights, points) - m_places[i]).squared_length());
    });
    return longest.empty() ? 0. : std::sqrt(*std::max_element(longest.begin(), longest.end()));
  }

private:
  static constexpr std::size_t block = 128; // of samples for a thread

  struct Sample
  {
    std::uint32_t chart, page, previous, next;
    Vector rest;
    Control_weights weights;
    double length = 0.;
    double wanted = 0., more = 0.; // of a gap there: see `set_gaps()`, and how much more of it
  };

  // Adds a factor times some weights.
  static void add(const Control_weights& weights, double factor, Control_weights& sum)
  {
    Control_weights result;
    result.reserve(sum.size() + weights.size());
    auto a = sum.begin();
    for(const Control_weight& b : weights) {
      for(; a != sum.end() && a->point < b.point; ++a)
        result.push_back(*a);
      const double before = a != sum.end() && a->point == b.point ? (a++)->weight : 0.;
      result.push_back({b.point, before + factor * b.weight});
    }
    result.insert(result.end(), a, sum.end());
    sum.swap(result);
  }

  // Of what leads along a border: to the outside, of length 1, or 0.
  static Vector outward(const Vector& along)
  {
    const double length = std::sqrt(along.squared_length());
    return length > 0. ? Vector{along.y, -along.x} * (1. / length) : Vector();
  }

  double reach() const { return 1.5 * m_sizes.gap + 6. * m_sizes.unit; }

  // Where the nearest point of a piece is at rest.
  Vector rest_of(const Nearest_on_piece& nearest) const
  {
    const Sample& begin = m_samples[nearest.piece->sample];
    return begin.rest * (1. - nearest.part) + m_samples[begin.next].rest * nearest.part;
  }

  std::vector<std::uint32_t> kept_vertices(const std::vector<std::uint32_t>& loop,
                                           const std::vector<Chart_shape::Point_2>& uv) const;
  Contact contact(std::uint32_t i, const Nearest_on_piece& nearest, const Vector& normal, double gap,
                  double wanted) const
  {
    return {i, nearest.piece->sample, nearest.part, normal, gap, wanted, m_samples[i].length};
  }
  void add_contacts_with_charts(std::uint32_t i, std::vector<Nearest_on_piece>& nearest,
                                std::vector<Contact>& contacts) const;
  void add_contacts_with_sides(std::uint32_t i, std::vector<Contact>& contacts) const;

  Contact_sizes m_sizes;
  std::vector<Sample> m_samples;
  std::vector<Contact> m_contacts;
  std::vector<Vector> m_places; // of the samples
  Border_pieces m_pieces;       // from each of which to the next one
  std::size_t m_pages = 1;
};

// Vertices at which pieces of about half the distance of samples begin, from which those between differ
// by hardly anything.
inline std::vector<std::uint32_t>
Border_contacts::kept_vertices(const std::vector<std::uint32_t>& loop,
                               const std::vector<Chart_shape::Point_2>& uv) const
{
  const double longest = 4.5 * m_sizes.unit, deviation = 0.2 * m_sizes.unit;
  const std::size_t n = loop.size();
  std::vector<std::uint32_t> result;
  const auto spans = [&](std::size_t begin, std::size_t end) {
    const Vector a = vector_of(uv[loop[begin]]), way = vector_of(uv[loop[end % n]]) - a;
    const double length = std::sqrt(way.squared_length());
    bool is_near = length <= longest;
    for(std::size_t i = begin + 1; i < end && is_near; ++i)
      is_near = std::abs(way.cross(vector_of(uv[loop[i]]) - a)) <= deviation * length;
    return is_near;
  };
  for(std::size_t begin = 0, end; begin < n; begin = end) {
    result.push_back(loop[begin]);
    for(end = begin + 1; end + 1 < n && spans(begin, end + 1);)
      ++end;
  }
  return result;
}

inline void Border_contacts::add_loop(std::uint32_t chart, std::uint32_t page,
                                      const std::vector<std::uint32_t>& loop,
                                      const std::vector<Chart_shape::Point_2>& uv,
                                      const Control_net& net)
{
  const double longest = 9. * m_sizes.unit;
  const std::vector<std::uint32_t> kept = kept_vertices(loop, uv);
  const std::size_t first = m_samples.size();
  Control_weights weights, next_weights;
  for(std::size_t i = 0; i < kept.size(); ++i) {
    const std::uint32_t v = kept[i], w = kept[(i + 1) % kept.size()];
    const Vector a = vector_of(uv[v]), way = vector_of(uv[w]) - a;
    const int parts = (std::max)(1, int(std::ceil(std::sqrt(way.squared_length()) / longest)));
    net.weigh(v, weights);
    net.weigh(w, next_weights);
    for(int k = 0; k < parts; ++k) {
      const double part = double(k) / parts;
      Sample sample;
      sample.chart = chart;
      sample.page = page;
      sample.rest = a + way * part;
      if(k == 0)
        sample.weights = weights;
      else {
        add(weights, 1. - part, sample.weights);
        add(next_weights, part, sample.weights);
      }
      m_samples.push_back(std::move(sample));
    }
  }
  const std::size_t n = m_samples.size() - first;
  for(std::size_t i = 0; i < n; ++i) {
    Sample &s = m_samples[first + i], &t = m_samples[first + (i + 1) % n];
    const double half = 0.5 * std::sqrt((t.rest - s.rest).squared_length());
    s.length += half;
    t.length += half;
    s.next = std::uint32_t(first + (i + 1) % n);
    t.previous = std::uint32_t(first + i);
  }
  m_pages = (std::max)(m_pages, std::size_t(page) + 1);
}

// The nearest point of each other chart, which may be on the wrong side, and that across a bay of its own
// chart: such gaps stay at least 0.7 of what they are at rest, if they need not be larger. `nearest` is for
// those of other charts.
inline void Border_contacts::add_contacts_with_charts(std::uint32_t i,
                                                      std::vector<Nearest_on_piece>& nearest,
                                                      std::vector<Contact>& contacts) const
{
  constexpr double facing = 0.3, kept = 0.7; // a cosine; of a gap within a chart
  const Sample& sample = m_samples[i];
  const Vector out = outward(m_places[sample.next] - m_places[sample.previous]);
  Nearest_on_piece own;
  double own_sign = 1.; // -1 where the sides of the bay have gone through each other
  own.squared_distance = (sample.wanted + sample.more) * (sample.wanted + sample.more);
  nearest.clear();
  const auto faces = [](double cosine, double squared_distance) { // the cosine times the distance
    return cosine > 0. && cosine * cosine > facing * facing * squared_distance;
  };
  // Unlike the sides of a thin part of the chart
  const auto faced_at_rest = [&](const Nearest_on_piece& near) {
    const Vector way = sample.rest - rest_of(near);
    const Vector out_at_rest = outward(m_samples[sample.next].rest - m_samples[sample.previous].rest);
    return faces(-out_at_rest.dot(way), way.squared_length());
  };
  // Pieces that face each other are turned to each other
  constexpr double turned = 0.82; // cos(pi - 2 acos(facing))
  const auto matters = [&](const Border_piece& piece) {
    return piece.chart != sample.chart
        || (piece.outward.dot(out) < turned && piece.sample != i && piece.sample != sample.previous);
  };
  m_pieces.for_each_near(sample.page, m_places[i], matters, [&](const Nearest_on_piece& near) {
    const Border_piece& piece = *near.piece;
    if(piece.chart == sample.chart) {
      const double squared = near.squared_distance;
      if(!(squared < own.squared_distance))
        return;
      const double there = piece.outward.dot(near.way), here = -out.dot(near.way);
      const bool is_across = faces(-there, squared) && faces(-here, squared) && faced_at_rest(near);
      if(is_across || (faces(there, squared) && faces(here, squared))) {
        own = near;
        own_sign = is_across ? -1. : 1.;
      }
      return;
    }
    const auto of_chart = std::find_if(nearest.begin(), nearest.end(), [&](const auto& n) {
      return n.piece->chart == piece.chart;
    });
    if(of_chart == nearest.end())
      nearest.push_back(near);
    else if(near.squared_distance < of_chart->squared_distance)
      *of_chart = near;
  });
  if(own.piece != nullptr && own.squared_distance > 0.) {
    const double distance = std::sqrt(own.squared_distance);
    const double least = (std::min)(sample.wanted + sample.more,
                                    kept * std::sqrt((sample.rest - rest_of(own)).squared_length()));
    if(own_sign * distance < least)
      contacts.push_back(contact(i, own, own.way * (own_sign / distance), own_sign * distance, least));
  }
  for(const Nearest_on_piece& near : nearest) {
    const std::uint32_t j = near.piece->sample, next = m_samples[j].next;
    const double distance = std::sqrt(near.squared_distance);
    Vector sum = near.piece->outward; // of the pieces that meet there
    if(near.part <= 0.)
      sum = sum + outward(m_places[j] - m_places[m_samples[j].previous]);
    else if(near.part >= 1.)
      sum = sum + outward(m_places[m_samples[next].next] - m_places[next]);
    const bool is_outside = sum.dot(near.way) > 0.;
    const Vector normal = distance > 1e-6 * m_sizes.unit ? near.way * ((is_outside ? 1. : -1.) / distance)
                                                         : near.piece->outward;
    const double gap = is_outside ? distance : -distance;
    if(gap < sample.wanted + sample.more)
      contacts.push_back(contact(i, near, normal, gap, sample.wanted + sample.more));
  }
}

inline void Border_contacts::add_contacts_with_sides(std::uint32_t i, std::vector<Contact>& contacts) const
{
  const Vector& p = m_places[i];
  const std::array<std::pair<Vector, double>, 4> sides
    = {{{{1., 0.}, p.x - m_sizes.low.x}, {{-1., 0.}, m_sizes.high.x - p.x},
        {{0., 1.}, p.y - m_sizes.low.y}, {{0., -1.}, m_sizes.high.y - p.y}}};
  for(const auto& [normal, gap] : sides)
    if(gap < m_samples[i].more)
      contacts.push_back({i, Contact::no_sample, 0., normal, gap, m_samples[i].more, m_samples[i].length});
}

inline void Border_contacts::set_gaps(const std::vector<Vector>& points)
{
  for(Sample& sample : m_samples) {
    const Vector out
      = outward(sum_of(m_samples[sample.next].weights, points)
                - sum_of(m_samples[sample.previous].weights, points));
    sample.wanted = m_sizes.gap / (std::max)({std::abs(out.x), std::abs(out.y), 0.7});
  }
}

inline void Border_contacts::find(const std::vector<Vector>& points)
{
  m_places.resize(m_samples.size());
  Blocked_execution::blocked_for(m_samples.size(), block, [&](std::size_t i, std::size_t end) {
    for(; i < end; ++i)
      m_places[i] = sum_of(m_samples[i].weights, points);
  });
  std::vector<Border_piece> pieces(m_samples.size());
  Blocked_execution::blocked_for(m_samples.size(), block, [&](std::size_t i, std::size_t end) {
    for(; i < end; ++i) {
      const Sample& s = m_samples[i];
      pieces[i] = Border_piece(std::uint32_t(i), s.chart, s.page, m_places[i], m_places[s.next] - m_places[i]);
    }
  });
  m_pieces.assign(pieces, m_pages);
  std::vector<std::vector<Contact>> found(Blocked_execution::number_of_blocks(m_samples.size(), block));
  Blocked_execution::blocked_for(m_samples.size(), block, [&](std::size_t begin, std::size_t end) {
    std::vector<Nearest_on_piece> nearest;
    for(std::uint32_t i = std::uint32_t(begin); i < end; ++i) {
      add_contacts_with_charts(i, nearest, found[begin / block]);
      add_contacts_with_sides(i, found[begin / block]);
    }
  });
  m_contacts.clear();
  for(const std::vector<Contact>& some : found)
    m_contacts.insert(m_contacts.end(), some.begin(), some.end());
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_BORDER_CONTACTS_H
