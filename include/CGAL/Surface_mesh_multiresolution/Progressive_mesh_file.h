// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_FILE_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_FILE_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_decoder.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_surface.h>
#include <CGAL/Surface_mesh_multiresolution/sort_batches.h>
#ifdef CGAL_HLSCM_DEFINITIONS
#include <CGAL/Surface_mesh_multiresolution/internal/file/Progressive_mesh_encoder.h>
#endif

#include <array>
#include <istream>
#include <limits>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/// \ingroup PkgHLSCMLevelsOfDetail
/// What a progressive mesh file keeps of coordinates.
enum class Progressive_mesh_precision
{
  QUANTIZED, ///< integers of a number of bits
  LOSSLESS   ///< all bits, 32 if `float` holds all values exactly, and 64 otherwise; and the order
};

/// \ingroup PkgHLSCMLevelsOfDetail
/// The order of the splits of a progressive mesh file.
enum class Progressive_mesh_order
{
  SORTED, ///< that of `sort_batches()` if possible, which makes the file a fifth smaller
  KEPT    ///< that of the mesh
};

/// \ingroup PkgHLSCMLevelsOfDetail
/// How a progressive mesh is written.
struct Progressive_mesh_write_options
{
  /// Whether coordinates are rounded or kept to the last bit.
  Progressive_mesh_precision precision = Progressive_mesh_precision::QUANTIZED;
  /// The bits of each coordinate, 1 to 30. Points lie on a lattice of 2^bits - 1 steps along the
  /// longest side of the bounding box, so that none is farther than half a step from where it was
  /// along each axis (`Progressive_mesh_decoder::position_error()`).
  int position_bits = 16;
  /// The same for texture coordinates. 16 bits are a 16th of a texel of a texture of 4096 x 4096.
  int uv_bits = 16;
  /// Whether splits may change places within their batches, and so the numbers of wedges, vertices
  /// and triangles. Without loss nothing changes in any case.
  Progressive_mesh_order order = Progressive_mesh_order::SORTED;
};

/// \ingroup PkgHLSCMLevelsOfDetail
/// A progressive mesh file in memory.
struct Progressive_mesh_bytes
  : Indexed_mesh::Mesh_outcome
{
  std::string bytes; ///< empty if there is an error
};

/// \ingroup PkgHLSCMLevelsOfDetail
/// What there is in a progressive mesh file. It has a status of its own since a file that is not
/// all there, or damaged behind some place, is a good mesh as far as it goes.
struct Read_progressive_mesh
{
  Progressive_mesh_file_status status; ///< whether it is all there
  std::string message;                 ///< the status in a sentence
  Textured_progressive_mesh mesh;      ///< what could be read; no wedges if nothing could
  std::size_t number_of_splits = 0;    ///< that the file should have
  double position_error = 0.;          ///< the bound on the error of a coordinate, but for rounding
  double uv_error = 0.;                ///< the same of a texture coordinate
};

/*!
\ingroup PkgHLSCMLevelsOfDetail

Returns `mesh` as a progressive mesh file (extension `.pm`): the coarsest mesh and the splits,
coarse to fine, so that any beginning of the file that has the coarsest mesh is a coarser model.

What is read back has the connectivity of `mesh`, or if quantized by default that of
`sort_batches(mesh)`, all numberings, the order of triangles and corners and `batch_ends` included;
`source_vertex` is not written. Where the sorted mesh would not be a manifold at some level, the order is kept. A mesh
without texture stays without. If lossless, coordinates have the same bits; if quantized, distinct
ones may become equal, and tiny triangles may flip.

A mesh that is not what the invariants of `Textured_progressive_mesh` say, has a chart that is not a
manifold, a wedge of more than 16384 neighbours at some level, more than 2^29 triangles, or a
coordinate that is not a finite number, is refused with an error.

\f$ O(n \log n) \f$ time, linear if the order is kept. Memory: about 160 bytes a wedge beside the
mesh, and a second mesh if it is sorted.
*/
CGAL_HLSCM_INLINE Progressive_mesh_bytes
encode_progressive_mesh(const Textured_progressive_mesh& mesh,
                        const Progressive_mesh_write_options& options = {});

#ifdef CGAL_HLSCM_DEFINITIONS

namespace internal {

inline bool is_float(const Textured_progressive_mesh& mesh)
{
  const auto is_exact = [](double x) {
    return std::abs(x) <= double((std::numeric_limits<float>::max)()) && double(float(x)) == x;
  };
  for(const auto& p : mesh.points)
    if(!is_exact(p.x()) || !is_exact(p.y()) || !is_exact(p.z()))
      return false;
  for(const auto& p : mesh.uv)
    if(!is_exact(p.x()) || !is_exact(p.y()))
      return false;
  return true;
}

// The least x, y, z, u, v, and the longest sides of the boxes of the points and of the uv.
inline std::pair<std::array<double, 5>, std::array<double, 2>>
bounding_boxes(const Textured_progressive_mesh& mesh)
{
  std::array<double, 5> lo = {}, hi = {};
  std::array<double, 2> side = {};
  for(int c = 0; c < (mesh.has_texture() ? 5 : 3); ++c) {
    lo[c] = hi[c] = c < 3 ? mesh.points[0][c] : mesh.uv[0][c - 3];
    const auto extend = [&](double x) {
      lo[c] = (std::min)(lo[c], x);
      hi[c] = (std::max)(hi[c], x);
    };
    if(c < 3)
      for(const auto& p : mesh.points)
        extend(p[c]);
    else
      for(const auto& p : mesh.uv)
        extend(p[c - 3]);
    side[c < 3 ? 0 : 1] = (std::max)(side[c < 3 ? 0 : 1], hi[c] - lo[c]);
  }
  return {lo, side};
}

// The header of a mesh without `error_in_numbers()`, but for the number of triangles of its base.
inline File_header header_for(const Textured_progressive_mesh& mesh,
                              const Progressive_mesh_write_options& options)
{
  const std::size_t splits = mesh.number_of_collapses();
  File_header header;
  header.has_texture = mesh.has_texture();
  header.fine = {std::uint32_t(mesh.number_of_wedges()), std::uint32_t(mesh.points.size()),
                 std::uint32_t(mesh.progressive_mesh.triangles.size())};
  header.base = {std::uint32_t(mesh.number_of_wedges_after(splits)),
                 std::uint32_t(mesh.number_of_vertices_after(splits)), 0};
  if(options.precision == Progressive_mesh_precision::LOSSLESS) {
    header.format = is_float(mesh) ? Value_format::FLOAT32 : Value_format::FLOAT64;
    return header;
  }
  header.position_bits = options.position_bits;
  header.uv_bits = options.uv_bits;
  const auto [origin, side] = bounding_boxes(mesh);
  header.origin = origin;
  header.step = {side[0] / header.mask(0), side[1] / header.mask(3)};
  return header;
}

} // namespace internal

CGAL_HLSCM_INLINE Progressive_mesh_bytes
encode_progressive_mesh(const Textured_progressive_mesh& mesh,
                        const Progressive_mesh_write_options& options)
{
  Progressive_mesh_bytes file;
  const auto is_possible = [](int bits) { return bits >= 1 && bits <= 30; };
  if(!is_possible(options.position_bits) || !is_possible(options.uv_bits))
    file.fail(Mesh_status::BAD_OPTIONS, "coordinates have 1 to 30 bits");
  if(file.fail(Mesh_status::BAD_MESH, internal::error_in_numbers(mesh)))
    return file;
  const internal::File_header header = internal::header_for(mesh, options);
  if(!std::isfinite(header.step[0]) || !std::isfinite(header.step[1])) {
    file.fail(Mesh_status::BAD_MESH, "the mesh is too large to be quantized");
    return file;
  }
  if(mesh.has_texture() && file.fail(Mesh_status::BAD_MESH, size_error(mesh.points)))
    return file;
  if(options.order == Progressive_mesh_order::SORTED
     && options.precision == Progressive_mesh_precision::QUANTIZED
     && !mesh.progressive_mesh.batch_ends.empty()) {
    const Textured_progressive_mesh sorted = sort_batches(mesh);
    internal::Progressive_mesh_encoder encoder(sorted, header);
    if(encoder.run().empty()) {
      file.bytes = encoder.take_bytes();
      return file;
    }
  }
  internal::Progressive_mesh_encoder encoder(mesh, header);
  if(!file.fail(Mesh_status::BAD_MESH, encoder.run()))
    file.bytes = encoder.take_bytes();
  return file;
}

#endif // CGAL_HLSCM_DEFINITIONS

/// \ingroup PkgHLSCMLevelsOfDetail
/// Writes `mesh` as a progressive mesh file; see `encode_progressive_mesh()`. `FAILED`: the stream
/// did not take it all.
inline Indexed_mesh::Mesh_outcome
write_progressive_mesh(std::ostream& to, const Textured_progressive_mesh& mesh,
                                          const Progressive_mesh_write_options& options = {})
{
  const Progressive_mesh_bytes file = encode_progressive_mesh(mesh, options);
  if(!file.is_ok())
    return file;
  to.write(file.bytes.data(), std::streamsize(file.bytes.size()));
  if(to.flush())
    return {};
  return {Mesh_status::FAILED, "the file cannot be written"};
}

/// \ingroup PkgHLSCMLevelsOfDetail
/// Writes what `build_progressive_mesh()` returns as a progressive mesh file without texture,
/// which is read back as a `Textured_progressive_mesh` without texture: with the
/// numbering of `coarse_first()`. A surface with an error is not written.
inline Indexed_mesh::Mesh_outcome
write_progressive_mesh(std::ostream& to, const Progressive_surface& surface,
                                          const Progressive_mesh_write_options& options = {})
{
  if(!surface.is_ok())
    return surface;
  return write_progressive_mesh(to, coarse_first(surface), options);
}

/// \ingroup PkgHLSCMLevelsOfDetail
/// Reads a progressive mesh file in memory, of which any beginning will do. Bytes behind its end
/// are ignored. For a file that arrives bit by bit see `Progressive_mesh_decoder`.
CGAL_HLSCM_INLINE Read_progressive_mesh decode_progressive_mesh(const char* data, std::size_t size);

#ifdef CGAL_HLSCM_DEFINITIONS

namespace internal {

inline Read_progressive_mesh what_was_read(Progressive_mesh_decoder&& decoder)
{
  Read_progressive_mesh result;
  result.status = decoder.status();
  result.message = decoder.message();
  result.number_of_splits = decoder.number_of_splits_in_file();
  result.position_error = decoder.position_error();
  result.uv_error = decoder.uv_error();
  result.mesh = std::move(decoder).mesh();
  return result;
}

} // namespace internal

CGAL_HLSCM_INLINE Read_progressive_mesh decode_progressive_mesh(const char* data, std::size_t size)
{
  Progressive_mesh_decoder decoder;
  decoder.push(data, size);
  return internal::what_was_read(std::move(decoder));
}

#endif // CGAL_HLSCM_DEFINITIONS

/// \ingroup PkgHLSCMLevelsOfDetail
/// Reads a progressive mesh file; see `decode_progressive_mesh()`.
CGAL_HLSCM_INLINE Read_progressive_mesh read_progressive_mesh(std::istream& from);

#ifdef CGAL_HLSCM_DEFINITIONS
CGAL_HLSCM_INLINE Read_progressive_mesh read_progressive_mesh(std::istream& from)
{
  Progressive_mesh_decoder decoder;
  std::vector<char> piece(std::size_t(1) << 20);
  while(from && decoder.status() == Progressive_mesh_file_status::TRUNCATED) {
    from.read(piece.data(), std::streamsize(piece.size()));
    decoder.push(piece.data(), std::size_t(from.gcount()));
  }
  return internal::what_was_read(std::move(decoder));
}
#endif // CGAL_HLSCM_DEFINITIONS

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_FILE_H
