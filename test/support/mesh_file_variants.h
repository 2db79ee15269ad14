// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_MESH_FILE_VARIANTS_H
#define HLSCM_TEST_SUPPORT_MESH_FILE_VARIANTS_H

// Ways to write the same mesh: bytes that all mean five points and two faces.

#include <support/read_meshes.h>

#include <cstdint>
#include <string>
#include <vector>

namespace read_meshes {

struct Variant
{
  std::string what;
  std::string name; // of the file
  std::string bytes;
};

inline const std::string bom = "\xef\xbb\xbf";

inline const std::string clean_obj = "v 0 0 0\nv 1 0 0.5\nv 1 1 -0.25\nv 0 1 1e-3\nv 2 0.5 0.125\n"
                              "f 1 2 3 4\nf 2 5 3\n";
inline const std::string clean_off = "OFF\n5 2 0\n0 0 0\n1 0 0.5\n1 1 -0.25\n0 1 1e-3\n2 0.5 0.125\n"
                              "4 0 1 2 3\n3 1 4 2\n";

inline std::string replaced(std::string text, const std::string& from, const std::string& to)
{
  for(std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

inline std::string utf16(const std::string& text, bool has_high_first)
{
  std::string bytes = has_high_first ? "\xfe\xff" : "\xff\xfe";
  for(const char c : text) {
    put(bytes, std::uint16_t(static_cast<unsigned char>(c)), has_high_first);
  }
  return bytes;
}

inline std::vector<Variant> obj_variants()
{
  const std::string& c = clean_obj;
  return {
      {"a byte order mark", "m.obj", bom + c},
      {"CR LF", "m.obj", replaced(c, "\n", "\r\n")},
      {"CR", "m.obj", replaced(c, "\n", "\r")},
      {"a byte order mark and CR", "m.obj", bom + replaced(c, "\n", "\r")},
      {"CR CR LF", "m.obj", replaced(c, "\n", "\r\r\n")},
      {"mixed ends of lines", "m.obj", replaced(replaced(c, "\nf", "\rf"), "0\nv", "0\r\nv")},
      {"odd white space", "m.obj", " \t" + replaced(replaced(c, " ", "\t \v"), "\n", " \f\n\n  ")},
      {"comments", "m.obj", "# first\n" + replaced(c, "\n", "# v 7 7 7\n#f 1 2 3\n\n") + "#"},
      {"UTF-16", "m.obj", utf16(c, false)},
      {"UTF-16, high bytes first", "m.obj", utf16("# \xe4\n" + c, true)},
      {"UTF-16 on the standard input", "-", utf16(c, false)},
      {"continued lines", "m.obj", replaced(c, " ", " \\\n ")},
      {"continued lines with CR LF", "m.obj", replaced(replaced(c, " ", " \\\n"), "\n", "\r\n")},
      {"continued lines with CR", "m.obj", replaced(replaced(c, " ", "\\\n"), "\n", "\r")},
      {"white space behind the backslash", "m.obj", replaced(c, " ", "\\ \t\n")},
      {"comments that seem to go on", "m.obj", replaced(c, "\n", " # C:\\\n")},
      {"a comment in a continued line", "m.obj", replaced(c, "0.5\n", "\\\n 0.5 # \\\n")},
      {"relative indices", "m.obj",
       replaced(replaced(c, "1 2 3 4", "-5 -4 -3 -2"), "2 5 3", "-4 5 -3")},
      {"slashes without anything", "m.obj",
       replaced(replaced(c, "1 2 3 4", "1/ 2// 3/ 4//"), "2 5 3", "2 5// 3/")},
      {"plus signs", "m.obj", replaced(replaced(c, " 1", " +1"), " 0.5", " +0.5e+0")},
      {"other numbers", "m.obj", replaced(replaced(c, " 0.5", " .5"), "1e-3", "0000.000100E1")},
      {"faces first", "m.obj", c.substr(c.find('f')) + c.substr(0, c.find('f'))},
      {"weights and colours", "m.obj",
       replaced(replaced(c, "0.5\n", "0.5 1\n"), "0.125\n", "0.125 0.1 0.2 0.3 1\n")},
      {"obsolete faces", "m.obj", replaced(c, "f ", "fo ")},
      {"other lines", "m.obj",
       "mtllib a.mtl\n" + replaced(c, "f 2", "g x y\nusemtl z\nl 1 2\np 1\nsurf 7\nf 2")},
      {"a name in capitals", "M.OBJ", c},
      {"no line feed at the end", "m.obj", c.substr(0, c.size() - 1)},
      {"packed", "m.obj.gz", packed(c)},
      {"packed, its name does not say so", "m.obj", packed(c)},
      {"packed, a name without a format", "m.gz", packed(c)},
      {"packed in two parts", "m.obj.gz", packed(c.substr(0, 20)) + packed(c.substr(20))},
      {"packed, with zeros behind", "m.obj.gz", packed(c) + std::string(512, '\0')},
      {"not packed, but its name says so", "m.obj.gz", c},
      {"the standard input", "-", c},
      {"the standard input with a comment first", "-", bom + "# OFF\n" + c},
      {"the standard input, packed", "-", packed(c)},
  };
}

inline std::vector<Variant> off_variants()
{
  const std::string& c = clean_off;
  const std::string points = "0 0 0 1 0 0.5 1 1 -0.25 0 1 1e-3 2 0.5 0.125";
  return {
      {"clean", "m.off", c},
      {"a byte order mark", "m.off", bom + c},
      {"CR LF", "m.off", replaced(c, "\n", "\r\n")},
      {"CR", "m.off", replaced(c, "\n", "\r")},
      {"comments", "m.off", "# OFF\n\n" + replaced(c, "\n", " # 7 7 7\n#\n")},
      {"a number stuck to the keyword", "m.off", replaced(c, "OFF\n", "OFF")},
      {"counts in the line of the keyword", "m.off", replaced(c, "OFF\n", "OFF ")},
      {"a word before the keyword", "m.off", "appearance { }\nLIST geom\n" + c},
      {"a word before the keyword in its line", "m.off", "{ " + c},
      {"no keyword", "m.off", c.substr(4)},
      {"no number of edges", "m.off", replaced(c, "5 2 0", "5 2")},
      {"several vertices in a line", "m.off", "OFF\n5 2 0\n" + points + "\n4 0 1 2 3\n3 1 4 2\n"},
      {"vertices over several lines", "m.off",
       "OFF\n5 2 0\n" + replaced(points, " ", "\n") + "\n4 0 1 2 3\n3 1 4 2\n"},
      {"the same with colours of faces", "m.off",
       "OFF\n5 2 0\n" + replaced(points, " ", "\n") + "\n4 0 1 2 3 0.1 0.2 0.3\n3 1 4 2 7\n"},
      {"faces over several lines", "m.off", "OFF\n5 2 0\n" + points + "\n4 0 1\n2 3\n3\n1 4 2\n"},
      {"all in one line", "m.off", "OFF 5 2 0 " + points + " 4 0 1 2 3 3 1 4 2"},
      {"colours of faces", "m.off",
       replaced(replaced(c, "2 3\n", "2 3 255 0 0\n"), "4 2\n", "4 2 0.5 0.5 0.5 1\n")},
      {"colours of vertices", "m.off",
       replaced(replaced(c, "OFF", "COFF"), "0.5\n", "0.5 1 2 3 4\n")},
      {"normals of vertices", "m.off",
       replaced(replaced(c, "OFF", "NOFF"), "0.5\n", "0.5 1 2 3\n")},
      {"the standard input", "-", "# it\n" + c},
      {"packed", "m.off.gz", packed(c)},
  };
}

inline std::string ply(const std::string& format, const std::string& vertices, const std::string& faces,
                const std::string& face_list = "list uchar int vertex_indices")
{
  return "ply\nformat " + format + " 1.0\ncomment x\nelement vertex 5\nproperty double x\n"
         + "property double y\nproperty double z\nelement face 2\nproperty " + face_list
         + "\nend_header\n" + vertices + faces;
}

// The bytes of the numbers.
template <typename T>
std::string raw(const std::vector<double>& numbers, bool is_big = false)
{
  std::string bytes;
  for(const double number : numbers) {
    put(bytes, T(number), is_big);
  }
  return bytes;
}

inline std::vector<Variant> ply_variants()
{
  const std::vector<double> xyz = {0, 0, 0, 1, 0, 0.5, 1, 1, -0.25, 0, 1, 1e-3, 2, 0.5, 0.125};
  const std::string text = "0 0 0\n1 0 0.5\n1 1 -0.25\n0 1 1e-3\n2 0.5 0.125\n";
  const std::string text_faces = "4 0 1 2 3\n3 1 4 2\n";
  const auto faces = [](bool is_big) {
    return raw<std::uint8_t>({4}) + raw<std::int32_t>({0, 1, 2, 3}, is_big) + raw<std::uint8_t>({3})
           + raw<std::int32_t>({1, 4, 2}, is_big);
  };
  const std::string little = "binary_little_endian", points = raw<double>(xyz);
  const std::string header = ply(little, "", "");
  const std::string vertex_header = "element vertex 5\nproperty double x\nproperty double y\n"
                                    "property double z\n";
  const std::string face_header = "element face 2\nproperty list uchar int vertex_indices\n";
  const std::string faces_first =
      replaced(replaced(header, vertex_header, ""), face_header, face_header + vertex_header);
  return {
      {"text", "m.ply", ply("ascii", text, text_faces)},
      {"text with CR LF", "m.ply", replaced(ply("ascii", text, text_faces), "\n", "\r\n")},
      {"text with CR", "m.ply", replaced(ply("ascii", text, text_faces), "\n", "\r")},
      {"text with a byte order mark", "m.ply", bom + ply("ascii", text, text_faces)},
      {"text on the standard input", "-", ply("ascii", text, text_faces)},
      {"text, faces first", "m.ply", replaced(faces_first, little, "ascii") + text_faces + text},
      {"unknown lines of the header", "m.ply",
       replaced(ply("ascii", text, text_faces), "comment x\n", "Created by a program\n")},
      {"binary", "m.ply", header + points + faces(false)},
      {"binary on the standard input", "-", header + points + faces(false)},
      {"binary, packed", "m.ply.gz", packed(header + points + faces(false))},
      {"binary with CR LF", "m.ply", replaced(header, "\n", "\r\n") + points + faces(false)},
      {"binary with CR", "m.ply", replaced(header, "\n", "\r") + points + faces(false)},
      {"binary, big end first", "m.ply",
       ply("binary_big_endian", raw<double>(xyz, true), faces(true))},
      {"binary, faces first", "m.ply", faces_first + faces(false) + points},
      {"binary with bytes behind", "m.ply", header + points + faces(false) + "\n\n"},
      {"binary, unsigned indices", "m.ply",
       ply(little, points, faces(false), "list uint8 uint32 vertex_index")},
      {"binary, short indices", "m.ply",
       ply(little, points,
           raw<std::uint16_t>({4}) + raw<std::int16_t>({0, 1, 2, 3}) + raw<std::uint16_t>({3})
               + raw<std::int16_t>({1, 4, 2}),
           "list ushort short vertex_indices")},
      {"binary, indices that are doubles", "m.ply",
       ply(little, points,
           raw<std::uint8_t>({4}) + raw<double>({0, 1, 2, 3}) + raw<std::uint8_t>({3})
               + raw<double>({1, 4, 2}),
           "list uchar double vertex_indices")},
      {"binary with more properties of faces", "m.ply",
       ply(little, points,
           raw<std::int16_t>({7}) + raw<std::uint8_t>({4}) + raw<std::int32_t>({0, 1, 2, 3})
               + raw<float>({0.5}) + raw<std::int16_t>({8}) + raw<std::uint8_t>({3})
               + raw<std::int32_t>({1, 4, 2}) + raw<float>({1}),
           "short flags\nproperty list uchar int vertex_indices\nproperty float quality")},
  };
}

} // namespace read_meshes

#endif // HLSCM_TEST_SUPPORT_MESH_FILE_VARIANTS_H
