// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_FUZZ_ERROR_OF_RECORD_BYTES_H
#define HLSCM_TEST_FUZZ_ERROR_OF_RECORD_BYTES_H

#include <CGAL/Surface_mesh_parameterization/internal/streamed/Ply_chart.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

namespace test_support {

// Takes the bytes for a PLY file that is mapped out of core: reads all of its records, and writes
// them with texture coordinates, which must be read as the same. Returns what is wrong.
inline std::string error_of_record_bytes(const std::string& bytes)
{
  namespace internal = CGAL::Surface_mesh_parameterization::internal;
  const std::string name = (std::filesystem::temp_directory_path()
                            / ("records_" + std::to_string(getpid()) + ".ply")).string();
  const auto write = [&name](const std::string& to_write) {
    std::ofstream(name, std::ios::binary) << to_write;
  };
  std::string error;
  try {
    write(bytes);
    const internal::Ply_chart chart(name); // what is bad in any record is refused here
    const internal::Ply_records& ply = chart.records();
    for(std::size_t v = 0; v < ply.number_of_vertices(); ++v)
      for(const double x : ply.point(v))
        if(!std::isfinite(x))
          error = "a point that is not finite";
    for(std::size_t f = 0; f < ply.number_of_faces(); ++f)
      for(const std::uint32_t v : ply.triangle(f))
        if(v >= ply.number_of_vertices())
          error = "a corner without a vertex";
    std::string again;
    internal::write_mapped_ply(ply, [](std::size_t) { return std::array<double, 2>{0.5, 0.25}; },
                               [&again](std::string_view part) { again += part; });
    const std::string second = name + ".ply";
    std::ofstream(second, std::ios::binary) << again;
    {
      const internal::Ply_records read(second);
      if(read.number_of_vertices() != ply.number_of_vertices()
         || read.number_of_faces() != ply.number_of_faces())
        error = "other numbers of vertices or faces are written";
      for(std::size_t v = 0; error.empty() && v < ply.number_of_vertices(); ++v)
        if(read.point(v) != ply.point(v))
          error = "another point is written";
      for(std::size_t f = 0; error.empty() && f < ply.number_of_faces(); ++f)
        if(!read.is_triangle(f) || read.triangle(f) != ply.triangle(f))
          error = "another face is written";
    }
    std::filesystem::remove(second);
  } catch(const internal::Streaming_failure& failure) {
    const std::string sentence = failure.what();
    if(sentence.empty() || sentence.find('\n') != std::string::npos)
      error = "no sentence: " + sentence;
  }
  std::filesystem::remove(name);
  return error;
}

} // namespace test_support

#endif // HLSCM_TEST_FUZZ_ERROR_OF_RECORD_BYTES_H
