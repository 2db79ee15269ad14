// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/Gltf_accessor.h"

#include "formats/byte_order.h"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace hlscm {
namespace gltf {

namespace {

enum Component_type {
  BYTE = 5120,
  UBYTE = 5121,
  SHORT = 5122,
  USHORT = 5123,
  UINT = 5125,
  FLOAT = 5126
};

std::size_t size_of(std::size_t component_type)
{
  switch(component_type) {
  case BYTE:
  case UBYTE:
    return 1;
  case SHORT:
  case USHORT:
    return 2;
  case UINT:
  case FLOAT:
    return 4;
  default:
    return 0;
  }
}

/// Where the elements of an accessor are, or those of a part of it.
struct Array
{
  std::size_t count;
  std::size_t components;
  std::size_t component_type;
  bool is_normalized;
  std::size_t stride;
  const char* data; // null: all are zero
};

// Takes the place of an array from a buffer view, which must hold it.
void locate(File& file, const Element& element, Array& array)
{
  const auto view = file.number(element, "bufferView");
  const std::size_t size = array.components * size_of(array.component_type);
  array.stride = size;
  array.data = nullptr;
  if(!view) {
    return;
  }
  const Element of_view = file.element("bufferViews", "buffer view", *view);
  const Json* extensions = File::member(of_view.json, "extensions");
  const std::size_t offset = file.number(element, "byteOffset").value_or(0);
  array.stride = file.number(of_view, "byteStride").value_or(size);
  constexpr std::size_t largest_stride = 65535;
  if(array.stride < size || array.stride > largest_stride) {
    file.fail(of_view.name, "has a stride of " + std::to_string(array.stride) + " bytes");
  }
  const bool is_packed = extensions != nullptr
                         && (extensions->contains("EXT_meshopt_compression")
                             || extensions->contains("KHR_meshopt_compression"));
  const Element buffer = file.element("buffers", "buffer", file.needed_number(of_view, "buffer"));
  if(is_packed && File::member(buffer.json, "uri") == nullptr) { // else it is there unpacked, too
    file.source().fail("it is compressed by meshopt (EXT_meshopt_compression), which cannot be "
                       "read, export the mesh without");
  }
  const Bytes bytes = file.view(*view);
  const std::size_t last = array.count > 0 ? offset + (array.count - 1) * array.stride + size : 0;
  if(last > bytes.size) {
    file.fail(element.name, "reaches up to byte " + std::to_string(last) + " of a buffer view of "
                                + std::to_string(bytes.size) + " bytes");
  }
  array.data = bytes.data + offset;
}

template <typename T>
double fraction(T value)
{
  return std::max(double(value) / double(std::numeric_limits<T>::max()), -1.);
}

template <typename T, typename Put>
void for_each_number_of(const Array& array, const Put& put)
{
  for(std::size_t i = 0; i < array.count; ++i) {
    const char* p = array.data + i * array.stride;
    for(std::size_t c = 0; c < array.components; ++c, p += sizeof(T)) {
      const T value = little_endian<T>(p);
      if constexpr(std::is_integral<T>::value) {
        put(i, c, array.is_normalized ? fraction(value) : double(value));
      } else {
        put(i, c, double(value));
      }
    }
  }
}

// Calls `put(element, component, number)`.
template <typename Put>
void for_each_number(const Array& array, const Put& put)
{
  switch(array.component_type) {
  case BYTE:
    return for_each_number_of<std::int8_t>(array, put);
  case UBYTE:
    return for_each_number_of<std::uint8_t>(array, put);
  case SHORT:
    return for_each_number_of<std::int16_t>(array, put);
  case USHORT:
    return for_each_number_of<std::uint16_t>(array, put);
  case UINT:
    return for_each_number_of<std::uint32_t>(array, put);
  default:
    return for_each_number_of<float>(array, put);
  }
}

Element part(const File& file, const Element& whole, const char* key)
{
  const Json* json = File::member(whole.json, key);
  if(json == nullptr || !json->is_object()) {
    file.fail(whole.name, std::string("has no ") + key);
  }
  return {*json, whole.name};
}

std::size_t component_type(const File& file, const Element& element)
{
  const std::size_t type = file.needed_number(element, "componentType");
  if(size_of(type) == 0) {
    file.fail(element.name, "has numbers of the unknown type " + std::to_string(type));
  }
  return type;
}

// The elements that a sparse accessor replaces.
struct Replacements
{
  std::vector<std::size_t> places;
  Array values;
};

Replacements replacements(File& file, const Element& element, const Array& array)
{
  const Element sparse = part(file, element, "sparse");
  const Element of_indices = part(file, sparse, "indices"),
                of_values = part(file, sparse, "values");
  Array indices{
      file.needed_number(sparse, "count"), 1, component_type(file, of_indices), false, 0, nullptr};
  Replacements result{{}, array};
  result.values.count = indices.count;
  locate(file, of_indices, indices);
  locate(file, of_values, result.values);
  if(indices.data == nullptr || result.values.data == nullptr) {
    file.fail(element.name, "has sparse elements without a buffer view");
  }
  for_each_number(indices, [&](std::size_t, std::size_t, double place) {
    if(!(place >= 0 && place < double(array.count))) {
      file.fail(element.name, "has a sparse element beyond its end");
    }
    result.places.push_back(std::size_t(place));
  });
  return result;
}

Array locate(File& file, const Element& element, const char* type, std::size_t components)
{
  if(File::text(element.json, "type") != type) {
    file.fail(element.name, std::string("should have the type ") + type);
  }
  const Json* normalized = File::member(element.json, "normalized");
  Array array{file.needed_number(element, "count"),
              components,
              component_type(file, element),
              normalized != nullptr && normalized->is_boolean() && normalized->get<bool>(),
              0,
              nullptr};
  file.source().check_index("elements of " + element.name, array.count);
  locate(file, element, array);
  return array;
}

// The numbers of an accessor, one element after the other, and the sparse ones in their places.
template <typename Number>
std::vector<Number> read_numbers(File& file, const Element& element, const Array& array)
{
  Replacements sparse;
  if(File::member(element.json, "sparse") != nullptr) {
    sparse = replacements(file, element, array);
  }
  if(array.data == nullptr && array.count > file.size()) { // no bytes bound their number
    file.fail(element.name, "promises " + std::to_string(array.count) + " elements without bytes");
  }
  std::vector<Number> numbers(array.count * array.components, Number(0));
  if(array.data != nullptr) {
    for_each_number(array, [&](std::size_t i, std::size_t c, double number) {
      numbers[i * array.components + c] = Number(number);
    });
  }
  if(!sparse.places.empty()) {
    for_each_number(sparse.values, [&](std::size_t i, std::size_t c, double number) {
      numbers[sparse.places[i] * array.components + c] = Number(number);
    });
  }
  return numbers;
}

} // namespace

std::size_t count_of_accessor(const File& file, std::size_t accessor)
{
  return file.needed_number(file.element("accessors", "accessor", accessor), "count");
}

std::vector<double> read_vectors(File& file, std::size_t accessor, std::size_t components)
{
  const Element element = file.element("accessors", "accessor", accessor);
  const Array array = locate(file, element, components == 2 ? "VEC2" : "VEC3", components);
  return read_numbers<double>(file, element, array);
}

std::vector<std::uint32_t> read_indices(File& file, std::size_t accessor)
{
  const Element element = file.element("accessors", "accessor", accessor);
  const Array array = locate(file, element, "SCALAR", 1);
  if(array.component_type != UBYTE && array.component_type != USHORT
     && array.component_type != UINT) {
    file.fail(element.name, "has indices that are no unsigned whole numbers");
  }
  if(array.is_normalized) {
    file.fail(element.name, "has indices that are fractions");
  }
  return read_numbers<std::uint32_t>(file, element, array);
}

} // namespace gltf
} // namespace hlscm
