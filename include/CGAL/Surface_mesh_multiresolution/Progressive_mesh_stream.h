// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_STREAM_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_STREAM_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/Section_decoder.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/progressive_mesh_format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/// \ingroup PkgHLSCMLevelsOfDetail
/// What the bytes of a progressive mesh file turn out to be.
enum class Progressive_mesh_file_status
{
  COMPLETE,           ///< all splits have been read
  TRUNCATED,          ///< sound so far, but more has to follow
  DAMAGED,            ///< not what was written from some place on
  OTHER_FORMAT,       ///< not a progressive mesh file
  UNSUPPORTED_VERSION ///< a progressive mesh file of a later version
};

/*!
\ingroup PkgHLSCMLevelsOfDetail

The class `Progressive_mesh_stream` reads a progressive mesh file as its bytes arrive, in pieces of
any size. At any time it has the mesh of the bytes so far: nothing until the coarsest mesh is there,
then a finer and finer mesh, each time a section is complete: 256 splits first, then half as many
as there are wedges, up to 4096.

It needs the standard library only, and knows nothing of CGAL: it is what a browser runs, and
`Progressive_mesh_decoder` makes of it a `Textured_progressive_mesh`.

The bytes may come from anywhere: what they say is checked, and however they lie they cost memory in
proportion to their number only, less than 2000 bytes for each, and no more than 32768 steps a split.
A section is taken as a whole or not at all, so that there is a valid mesh before any damage.

Linear time. Memory: 64 bytes a wedge beside the mesh, 48 if coordinates have 16 bits at most.
*/
class Progressive_mesh_stream
{
public:
  /// Takes the next bytes of the file. Bytes behind its end or behind damage have no effect.
  void push(const char* data, std::size_t size);

  /// Returns what the bytes so far are: `TRUNCATED` as long as more has to follow.
  Progressive_mesh_file_status status() const { return m_status; }

  /// Returns the status in a sentence.
  std::string message() const;

  /// Returns whether there is a mesh.
  bool has_mesh() const { return m_has_base; }

  /// Returns the number of splits that have been read.
  std::size_t number_of_splits() const { return m_sections.number_of_splits(); }

  /// Returns the number of splits that the file should have; 0 before its header is there.
  std::size_t number_of_splits_in_file() const { return m_header.number_of_splits(); }

  /// Returns the bound on the error of each coordinate of a point, but for rounding: 0 if lossless.
  double position_error() const { return 0.5 * m_header.step[0]; }

  /// Returns the bound on the error of each texture coordinate, but for rounding: 0 if lossless.
  double uv_error() const { return 0.5 * m_header.step[1]; }

  /// Returns whether there is a texture, or just the surface.
  bool has_texture() const { return m_header.has_texture; }

  /// Returns the number of wedges so far.
  std::size_t number_of_wedges() const { return m_has_base ? grown().number_of_wedges() : 0; }

  /// Returns the number of vertices so far.
  std::size_t number_of_vertices() const { return m_has_base ? grown().number_of_vertices() : 0; }

  /// Returns the number of triangles so far.
  std::size_t number_of_triangles() const
  {
    return m_has_base ? grown().rings.number_of_triangles() : 0;
  }

  /// Returns the triangles so far, three wedges each, those of each level first; null if there are
  /// none. `push()` makes the pointer invalid.
  const Triangle_indices* triangles() const
  {
    return m_has_base ? grown().rings.triangles().data() : nullptr;
  }

  /// Returns the vertex of each wedge so far; null if there are none.
  const Vertex_index* vertices() const { return m_has_base ? grown().vertex.data() : nullptr; }

  /// Returns the wedge into which the first wedge that was split off collapses, that of the second,
  /// and so on: `number_of_splits()` of them.
  const Vertex_index* parents() const { return grown().parents.data(); }

  /// Calls `use(w, x)` for the wedges from `begin` to `end` - 1 with their coordinates, an
  /// `std::array<double, 5>` of x, y, z, u, v; the last two are 0 without texture.
  /// Precondition: they are there.
  template <class Use>
  void visit_coordinates(std::size_t begin, std::size_t end, const Use& use) const
  {
    grown().visit_coordinates(begin, end, use);
  }

private:
  friend class Progressive_mesh_decoder; // which needs CGAL, as this must not
  enum class Part { HEADER, SECTION_HEADER, SECTION };

  static constexpr std::size_t max_splits = internal::splits_per_section + 1; // of a section

  const internal::Growing_mesh& grown() const { return m_sections.mesh(); }
  internal::Growing_mesh take_grown() { return m_sections.take_mesh(); }
  bool is_over() const { return m_status != Progressive_mesh_file_status::TRUNCATED; }
  void refuse(Progressive_mesh_file_status status) { m_status = status; }
  void expect(Part part, std::size_t size)
  {
    m_part = part;
    m_part_size = size;
  }
  void check_beginning(const char* data, std::size_t size);
  void take_part(const char* data);
  void take_header(const char* data);
  void take_section_header(const char* data);
  void take_section(const char* data);

  Progressive_mesh_file_status m_status = Progressive_mesh_file_status::TRUNCATED;
  Part m_part = Part::HEADER;
  std::size_t m_part_size = internal::file_header_size;
  std::size_t m_bytes_behind = 0;  // behind the present part, as far as they are known
  std::vector<char> m_pending;     // the beginning of a part whose end has not come yet
  std::vector<char> m_section;     // memory
  std::uint32_t m_splits = 0, m_crc = 0, m_wanted_crc = 0;
  bool m_has_base = false;
  internal::File_header m_header;
  internal::Section_decoder m_sections;
};

#ifdef CGAL_HLSCM_DEFINITIONS

CGAL_HLSCM_INLINE void Progressive_mesh_stream::push(const char* data, std::size_t size)
{
  if(m_part == Part::HEADER)
    check_beginning(data, size);
  while(!is_over()) {
    const bool is_whole = m_pending.empty() && size >= m_part_size; // no need to copy
    const std::size_t taken = (std::min)(size, m_part_size - m_pending.size());
    if(!is_whole)
      m_pending.insert(m_pending.end(), data, data + taken);
    const char* part = is_whole ? data : m_pending.data();
    if(!is_whole && m_pending.size() < m_part_size)
      return;
    data += taken;
    size -= taken;
    m_bytes_behind = size;
    take_part(part);
    m_pending.clear();
  }
}

// Other formats are known by their first bytes, and later versions may have another header.
CGAL_HLSCM_INLINE void Progressive_mesh_stream::check_beginning(const char* data, std::size_t size)
{
  for(std::size_t i = 0; i < size && !is_over(); ++i) {
    const std::size_t at = m_pending.size() + i;
    const auto byte = static_cast<unsigned char>(data[i]);
    if(at < internal::file_magic.size() && byte != internal::file_magic[at])
      refuse(Progressive_mesh_file_status::OTHER_FORMAT);
    else if((at == 8 && (byte < internal::oldest_version || byte > internal::latest_version))
            || (at == 9 && byte != 0))
      refuse(Progressive_mesh_file_status::UNSUPPORTED_VERSION);
    else if(at > 9)
      return;
  }
}

CGAL_HLSCM_INLINE void Progressive_mesh_stream::take_part(const char* data)
{
  if(m_part == Part::HEADER)
    take_header(data);
  else if(m_part == Part::SECTION_HEADER)
    take_section_header(data);
  else
    take_section(data);
}

CGAL_HLSCM_INLINE void Progressive_mesh_stream::take_header(const char* data)
{
  const std::size_t crc_at = internal::file_header_size - 4;
  const internal::File_header header = internal::header_of(data);
  m_crc = internal::crc32(data, crc_at);
  if(m_crc != internal::load_little_endian(data + crc_at, 4) || !internal::is_sound(header))
    return refuse(Progressive_mesh_file_status::DAMAGED);
  m_header = header;
  m_sections = internal::Section_decoder(header);
  expect(Part::SECTION_HEADER, internal::section_header_size);
}

CGAL_HLSCM_INLINE void Progressive_mesh_stream::take_section_header(const char* data)
{
  m_splits = std::uint32_t(internal::load_little_endian(data, 4));
  m_wanted_crc = std::uint32_t(internal::load_little_endian(data + 8, 4));
  const std::size_t size = std::size_t(internal::load_little_endian(data + 4, 4));
  const std::size_t missing = number_of_splits_in_file() - number_of_splits();
  const bool is_sound = m_has_base
                          ? m_splits >= 1 && m_splits <= (std::min)(missing, max_splits)
                              && size <= internal::max_section_bytes(m_splits)
                              && (!m_header.has_symbols
                                  || size >= internal::min_section_bytes(m_splits))
                          : m_splits == 0;
  if(!is_sound)
    return refuse(Progressive_mesh_file_status::DAMAGED);
  expect(Part::SECTION, size);
}

CGAL_HLSCM_INLINE void Progressive_mesh_stream::take_section(const char* data)
{
  m_crc = internal::section_crc(m_splits, data, m_part_size, m_crc);
  if(m_crc != m_wanted_crc)
    return refuse(Progressive_mesh_file_status::DAMAGED);
  m_section.assign(data, data + m_part_size);
  m_section.resize(m_part_size + internal::Section_decoder::slack(m_splits), 0);
  const bool is_sound = m_has_base
                          ? m_sections.read_splits(m_splits, m_section.data(), m_part_size)
                          : m_sections.read_base(m_section.data(), m_part_size);
  if(!is_sound)
    return refuse(Progressive_mesh_file_status::DAMAGED);
  if(!m_has_base)
    m_sections.reserve(m_bytes_behind);
  m_has_base = true;
  if(number_of_splits() == number_of_splits_in_file())
    m_status = Progressive_mesh_file_status::COMPLETE;
  expect(Part::SECTION_HEADER, internal::section_header_size);
}

CGAL_HLSCM_INLINE std::string Progressive_mesh_stream::message() const
{
  const std::string splits = std::to_string(number_of_splits()) + " of its "
                           + std::to_string(number_of_splits_in_file()) + " splits";
  const std::string so_far = m_has_base ? "the mesh has " + splits
                                        : std::string("there is no mesh before that");
  switch(m_status) {
  case Progressive_mesh_file_status::COMPLETE:
    return "the file is complete";
  case Progressive_mesh_file_status::TRUNCATED:
    return m_has_base ? "the file ends early: " + so_far
                      : "the file ends before its coarsest mesh is complete";
  case Progressive_mesh_file_status::DAMAGED:
    return "the file is damaged: " + so_far;
  case Progressive_mesh_file_status::OTHER_FORMAT:
    return "this is not a progressive mesh file";
  default:
    return "this is a progressive mesh file of another version than "
         + std::to_string(internal::oldest_version) + " to "
         + std::to_string(internal::latest_version);
  }
}

#endif // CGAL_HLSCM_DEFINITIONS

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_STREAM_H
