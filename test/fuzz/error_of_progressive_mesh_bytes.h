// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_FUZZ_ERROR_OF_PROGRESSIVE_MESH_BYTES_H
#define HLSCM_TEST_FUZZ_ERROR_OF_PROGRESSIVE_MESH_BYTES_H

#include <support/mesh_properties.h>

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_file.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace test_support {

// The bytes with the checksums that the header and each section should have, as far as they can be
// found: what a reader then relies on is what it checks itself.
inline std::string with_right_checksums(std::string bytes)
{
  namespace internal = CGAL::Surface_mesh_multiresolution::internal;
  const auto number = [&bytes](std::size_t at) {
    return std::uint32_t(internal::load_little_endian(bytes.data() + at, 4));
  };
  const auto put = [&bytes](std::size_t at, std::uint32_t crc) {
    std::string four;
    internal::append_little_endian(four, crc, 4);
    std::copy(four.begin(), four.end(), bytes.begin() + std::ptrdiff_t(at));
  };
  std::size_t at = internal::file_header_size;
  if(bytes.size() < at)
    return bytes;
  std::uint32_t crc = internal::crc32(bytes.data(), at - 4);
  put(at - 4, crc);
  while(bytes.size() - at >= internal::section_header_size) {
    const std::size_t size = number(at + 4), from = at + internal::section_header_size;
    if(size > bytes.size() - from)
      break;
    crc = internal::section_crc(number(at), bytes.data() + from, size, crc);
    put(at + 8, crc);
    at = from + size;
  }
  return bytes;
}

// What is wrong with a mesh that was read from anything.
inline std::string error_in_read_mesh(
  const CGAL::Surface_mesh_multiresolution::Read_progressive_mesh& read)
{
  using Status = CGAL::Surface_mesh_multiresolution::Progressive_mesh_file_status;
  const auto& mesh = read.mesh;
  const auto& pm = mesh.progressive_mesh;
  const std::size_t n = mesh.number_of_wedges();
  if(read.message.empty())
    return "no message";
  if(n == 0)
    return read.status != Status::COMPLETE && mesh.points.empty() ? "" : "complete, but no mesh";
  if(read.status == Status::COMPLETE && mesh.number_of_collapses() != read.number_of_splits)
    return "complete, but not all splits";
  if(mesh.vertex.size() != n || (mesh.has_texture() && mesh.uv.size() != n) || mesh.points.size() != mesh.vertex[n - 1] + 1u)
    return "arrays of different sizes";
  for(std::size_t w = 1; w < n; ++w)
    if(mesh.vertex[w] - mesh.vertex[w - 1] > 1)
      return "vertices that are not in the order of wedges";
  for(std::size_t k = 0; k < mesh.number_of_collapses(); ++k)
    if(!mesh.is_whole(k) && (!mesh.is_whole(0) || !mesh.is_whole(k + 1)
        || mesh.vertex[pm.collapses[k].kept] != mesh.vertex[pm.collapses[k - 1].kept]))
      return "a wrong pair at " + std::to_string(k);
  for(const auto& p : mesh.points)
    if(!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z()))
      return "a point that is not finite";
  const std::string error = error_in_collapses(pm);
  if(!error.empty() && error != "batch ends do not ascend") // equal ends do no harm
    return error;
  return error_in_levels(pm, 2);
}

// Reads the bytes at once, in pieces, and as the writer writes what was read; returns what is
// wrong.
inline std::string error_of_progressive_mesh_bytes(const std::string& bytes)
{
  namespace SMM = CGAL::Surface_mesh_multiresolution;
  const SMM::Read_progressive_mesh whole = SMM::decode_progressive_mesh(bytes.data(), bytes.size());
  const std::string error = error_in_read_mesh(whole);
  if(!error.empty())
    return error;
  SMM::Progressive_mesh_decoder decoder;
  for(std::size_t at = 0, size = 1; at < bytes.size(); at += size, size = size * 3 % 1009) {
    const std::string piece = bytes.substr(at, size);
    decoder.push(piece.data(), piece.size());
  }
  if(decoder.status() != whole.status || decoder.message() != whole.message)
    return "in pieces: " + decoder.message();
  if(decoder.mesh().progressive_mesh.triangles != whole.mesh.progressive_mesh.triangles)
    return "in pieces: other triangles";
  if(whole.mesh.number_of_wedges() == 0)
    return "";
  SMM::Progressive_mesh_write_options lossless;
  lossless.precision = SMM::Progressive_mesh_precision::LOSSLESS;
  lossless.order = SMM::Progressive_mesh_order::KEPT;
  const SMM::Progressive_mesh_bytes again = SMM::encode_progressive_mesh(whole.mesh, lossless);
  const SMM::Read_progressive_mesh second
    = SMM::decode_progressive_mesh(again.bytes.data(), again.bytes.size());
  if(second.status != SMM::Progressive_mesh_file_status::COMPLETE)
    return "written again: " + again.error;
  const bool is_same = second.mesh.progressive_mesh.triangles == whole.mesh.progressive_mesh.triangles
                    && second.mesh.points == whole.mesh.points && second.mesh.uv == whole.mesh.uv
                    && second.mesh.vertex == whole.mesh.vertex;
  return is_same ? "" : "written again: another mesh";
}

} // namespace test_support

#endif
