// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_POLYGONAL_BORDER_PARAMETERIZER_3_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_POLYGONAL_BORDER_PARAMETERIZER_3_H

#include <CGAL/Kernel_traits.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Surface_mesh_parameterization/Error_code.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/*!
\ingroup PkgHLSCMStretch

The class `Polygonal_border_parameterizer_3` lays a border along any polygon, by the lengths of its edges.

The first corner is where the border begins, at the source of the halfedge given; the other corners come
to the vertices that are nearest to them by length. All corners are hit, and on each side of the polygon
lengths are kept up to a factor. Unlike CGAL's own border parameterizers it also takes polygons that
are not convex, to which `Low_stretch_parameterizer_3` mostly finds a map without a flipped face; maps by
convex combinations, as `Mean_value_coordinates_parameterizer_3`, need a convex one.

Linear time, besides \f$ O(k \log k) \f$ to look at the \f$ k \f$ corners of the polygon.

\tparam TriangleMesh a model of `FaceGraph` and `HalfedgeListGraph`

\cgalModels{Parameterizer_3 of CGAL's Triangulated Surface Mesh Parameterization}

\sa CGAL's `Circular_border_arc_length_parameterizer_3` and `Square_border_arc_length_parameterizer_3`
*/
template <class TriangleMesh_>
class Polygonal_border_parameterizer_3
{
public:
  /// The mesh.
  typedef TriangleMesh_ TriangleMesh;
  typedef TriangleMesh_ Triangle_mesh; ///< the same, by the name that CGAL 5.5 and later use
  /// A vertex of the mesh.
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor vertex_descriptor;
  /// A halfedge of the mesh.
  typedef typename boost::graph_traits<TriangleMesh>::halfedge_descriptor halfedge_descriptor;
  /// The map of the mesh from vertices to points.
  typedef typename boost::property_map<TriangleMesh, boost::vertex_point_t>::const_type
    Vertex_point_map;
  /// The kernel of these points.
  typedef typename Kernel_traits<
    typename boost::property_traits<Vertex_point_map>::value_type>::Kernel Kernel;
  /// A parameter (u, v).
  typedef typename Kernel::Point_2 Point_2;

  /// Constructs the parameterizer of a polygon, by its corners in either direction.
  explicit Polygonal_border_parameterizer_3(std::vector<Point_2> corners) : m_corners(std::move(corners))
  {
    if(is_polygon() && orientation_2(m_corners.begin(), m_corners.end(), Kernel()) == LEFT_TURN)
      std::reverse(m_corners.begin() + 1, m_corners.end()); // borders have the surface on their right side
  }

  /*!
  Puts the vertices of a border along the polygon.

  \param mesh the mesh; it is not changed
  \param bhd a halfedge on its border
  \param uvmap a model of `ReadWritePropertyMap` with the vertex descriptor as key and `Point_2` as
         value; written for each vertex of the border
  \param vpmap a model of `ReadWritePropertyMap` with the vertex descriptor as key and `bool` as
         value; set to `true` for these

  \return `OK`; `ERROR_WRONG_PARAMETER` if the corners are no simple polygon, with a coordinate that is not
  finite for instance; `ERROR_BORDER_TOO_SHORT` if `bhd` is on no border of `mesh`, or if that has fewer
  vertices than the polygon has corners, or no length that is a finite number
  */
  template <class VertexUVMap, class VertexIndexMap, class VertexParameterizedMap>
  Error_code parameterize(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap,
                          VertexIndexMap, VertexParameterizedMap vpmap) const;

  /// Returns whether the polygon is convex.
  bool is_border_convex() const
  {
    return is_polygon() && is_convex_2(m_corners.begin(), m_corners.end(), Kernel());
  }

private:
  bool is_polygon() const
  {
    const auto is_infinite = [](const Point_2& p) {
      return !std::isfinite(to_double(p.x())) || !std::isfinite(to_double(p.y()));
    };
    return m_corners.size() >= 3 && std::none_of(m_corners.begin(), m_corners.end(), is_infinite)
        && is_simple_2(m_corners.begin(), m_corners.end(), Kernel());
  }

  const Point_2& corner(std::size_t i) const { return m_corners[i % m_corners.size()]; }

  // The length up to each corner, and that around.
  std::vector<double> lengths_up_to_corners() const
  {
    std::vector<double> result(1, 0.);
    for(std::size_t i = 0; i < m_corners.size(); ++i)
      result.push_back(result.back() + std::sqrt(to_double(squared_distance(corner(i), corner(i + 1)))));
    return result;
  }

  std::vector<std::size_t> vertices_of_corners(const std::vector<double>& up_to) const;

  std::vector<Point_2> m_corners; // clockwise
};

// The position along the border of the vertex of each corner, and that behind the end. `up_to`: the
// length up to each vertex, and that around.
template <class TriangleMesh>
std::vector<std::size_t> Polygonal_border_parameterizer_3<TriangleMesh>::
vertices_of_corners(const std::vector<double>& up_to) const
{
  const std::vector<double> up_to_corners = lengths_up_to_corners();
  const double factor = up_to.back() / up_to_corners.back();
  const std::size_t corners = m_corners.size(), vertices = up_to.size() - 1;
  std::vector<std::size_t> result(1, 0);
  for(std::size_t i = 1; i < corners; ++i) {
    const double length = factor * up_to_corners[i];
    const std::size_t least = result.back() + 1, most = vertices - (corners - i);
    std::size_t at = least; // each side has a vertex for its first corner
    while(at < most && std::abs(up_to[at + 1] - length) < std::abs(up_to[at] - length))
      ++at;
    result.push_back(at);
  }
  result.push_back(vertices);
  return result;
}

template <class TriangleMesh>
template <class VertexUVMap, class VertexIndexMap, class VertexParameterizedMap>
Error_code Polygonal_border_parameterizer_3<TriangleMesh>::
parameterize(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap, VertexIndexMap,
             VertexParameterizedMap vpmap) const
{
  if(!is_polygon())
    return ERROR_WRONG_PARAMETER;
  const auto all = halfedges(mesh); // what is none of them must not be asked for anything
  if(std::find(all.begin(), all.end(), bhd) == all.end() || !is_border(bhd, mesh))
    return ERROR_BORDER_TOO_SHORT;
  const auto point = get(boost::vertex_point, mesh);
  std::vector<vertex_descriptor> along;
  std::vector<double> up_to(1, 0.);
  for(const halfedge_descriptor h : halfedges_around_face(bhd, mesh)) {
    along.push_back(source(h, mesh));
    up_to.push_back(up_to.back()
                    + std::sqrt(to_double(squared_distance(get(point, source(h, mesh)),
                                                           get(point, target(h, mesh))))));
  }
  if(along.size() < m_corners.size() || !(up_to.back() > 0.) || !std::isfinite(up_to.back()))
    return ERROR_BORDER_TOO_SHORT;
  const std::vector<std::size_t> first = vertices_of_corners(up_to);
  for(std::size_t side = 0; side < m_corners.size(); ++side) {
    const std::size_t begin = first[side], end = first[side + 1];
    const double length = up_to[end] - up_to[begin];
    for(std::size_t i = begin; i < end; ++i) {
      const double part = length > 0. ? (up_to[i] - up_to[begin]) / length
                                      : double(i - begin) / double(end - begin);
      put(uvmap, along[i], corner(side) + part * (corner(side + 1) - corner(side)));
      put(vpmap, along[i], true);
    }
  }
  return OK;
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_POLYGONAL_BORDER_PARAMETERIZER_3_H
