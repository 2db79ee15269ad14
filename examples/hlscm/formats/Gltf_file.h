// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_GLTF_FILE_H
#define HLSCM_PROGRAM_GLTF_FILE_H

#include "formats/Mesh_source.h"
#include "reading/File_bytes.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hlscm {
namespace gltf {

using Json = nlohmann::json;

/// Bytes of someone else.
struct Bytes
{
  const char* data = nullptr;
  std::size_t size = 0;
};

/// An element of one of the arrays of a file, such as accessor 3.
struct Element
{
  const Json& json;
  std::string name; ///< for messages: "accessor 3"
};

/// The parts of a .glb or .gltf file: what it says in JSON, and its buffers, which are read when
/// they are asked for. Whatever is not as the format wants it is refused by its name.
///
/// Not by a library for glTF: tinygltf, for one, ends by a signal on deeply nested JSON, and
/// refuses meshes for the sake of their images.
class File
{
public:
  explicit File(const Mesh_source& source);

  const Mesh_source& source() const { return m_source; }
  const Json& json() const { return m_json; }

  [[noreturn]] void fail(const std::string& element, const std::string& what) const
  {
    m_source.fail(element + " " + what + ", the file is damaged: export it again");
  }

  /// A member of an object; null if there is none.
  static const Json* member(const Json& object, const char* key)
  {
    if(!object.is_object()) {
      return nullptr;
    }
    const auto found = object.find(key);
    return found != object.end() ? &*found : nullptr;
  }

  /// A member that is a whole number from 0 on; nothing if there is none.
  std::optional<std::size_t> number(const Element& element, const char* key) const;

  /// The same where there must be one.
  std::size_t needed_number(const Element& element, const char* key) const;

  /// A member that is a text; empty if there is none.
  static std::string text(const Json& object, const char* key)
  {
    const Json* value = member(object, key);
    return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
  }

  /// An element of an array of the file ("accessors") by the word for one ("accessor").
  Element element(const char* array, const char* word, std::size_t index) const;

  /// How many elements an array of the file has.
  std::size_t count(const char* array) const;

  /// The bytes of a buffer view.
  Bytes view(std::size_t index);

  /// How many bytes the file and the buffers read so far have.
  std::size_t size() const { return m_size; }

private:
  struct Buffer
  {
    bool is_read = false;
    std::string decoded; // of a data URI
    File_bytes file;     // of a file beside this one
    Bytes bytes;
  };

  void parse_json(const char* begin, const char* end);
  void read_chunks();
  Bytes buffer(std::size_t index);
  void read_buffer(const Element& element, Buffer& buffer);

  const Mesh_source& m_source;
  Json m_json;
  std::optional<Bytes> m_chunk; // the binary one of a .glb file
  std::vector<Buffer> m_buffers;
  std::size_t m_size;
};

} // namespace gltf
} // namespace hlscm

#endif // HLSCM_PROGRAM_GLTF_FILE_H
