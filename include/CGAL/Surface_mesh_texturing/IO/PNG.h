// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_IO_PNG_H
#define CGAL_SURFACE_MESH_TEXTURING_IO_PNG_H

#include <CGAL/Surface_mesh_texturing/Texture_image.h>
#include <CGAL/Surface_mesh_texturing/internal/writing/Byte_output.h>

#include <boost/predef/other/endian.h>

#include <png.h>

#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

inline void append_png(png_structp png, png_bytep data, std::size_t size)
{
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<char*>(data), size);
}

// The samples of an image as libpng takes them, the higher byte of two in either order.
struct Png_samples
{
  const unsigned char* bytes;
  std::size_t width, height, channels;
  int bits;
};

// Nothing here may need a destructor: errors of libpng jump out.
inline bool put_png(png_structp png, png_infop info, const Png_samples& image, int compression)
{
  constexpr int color_types[]
    = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
  if(setjmp(png_jmpbuf(png)))
    return false;
  png_set_compression_level(png, compression);
  png_set_IHDR(png, info, png_uint_32(image.width), png_uint_32(image.height), image.bits,
               color_types[image.channels - 1], PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  if(image.bits == 16 && BOOST_ENDIAN_LITTLE_BYTE)
    png_set_swap(png);
  const std::size_t row = image.width * image.channels * std::size_t(image.bits) / 8;
  for(std::size_t y = 0; y < image.height; ++y)
    png_write_row(png, image.bytes + y * row);
  png_write_end(png, info);
  return true;
}

inline void ignore_png_message(png_structp, png_const_charp) {}

[[noreturn]] inline void jump_out_of_png(png_structp png, png_const_charp)
{
  png_longjmp(png, 1);
}

} // namespace internal

/// \ingroup PkgHLSCMTextureFiles
/// The struct `PNG_options` says how the numbers of an image become those of a PNG file.
struct PNG_options
{
  int bits = 8;         ///< of a channel: 8 or 16
  double lowest = 0.;   ///< becomes 0, as what is below does; -1 for normal maps
  double highest = 1.;  ///< becomes the largest number, as what is above does
  int compression = 4;  ///< 0 to 9; beyond 4, normal maps of scans hardly get any smaller
};

namespace IO {

/*!
\ingroup PkgHLSCMTextureFiles

Returns the bytes of a PNG file; empty if there is an error: no texels, numbers that do not fit
together, or a failure of libpng, with which the program must be linked.

\tparam Integer `std::uint8_t` or `std::uint16_t`
\param samples row by row from the top, the channels of a texel side by side
\param width of the image, in texels
\param channels of a texel: 1 (grey), 2 (grey, opacity), 3 (colors) or 4 (colors, opacity)
\param compression 0 to 9, see `PNG_options`
*/
template <class Integer>
std::string encode_PNG(const std::vector<Integer>& samples, std::size_t width,
                       std::size_t channels = 3, int compression = PNG_options().compression)
{
  static_assert(std::is_unsigned<Integer>::value && sizeof(Integer) <= 2, "8 or 16 bits");
  constexpr std::size_t longest_side = 1000000; // libpng's own bound
  std::string bytes;
  if(width == 0 || width > longest_side || channels == 0 || channels > 4 || samples.empty()
     || samples.size() % (channels * width) != 0 || compression < 0 || compression > 9)
    return bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr,
                                            internal::jump_out_of_png,
                                            internal::ignore_png_message);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  bool is_good = info != nullptr;
  if(is_good) {
    png_set_write_fn(png, &bytes, internal::append_png, nullptr);
    const internal::Png_samples image
      = {reinterpret_cast<const unsigned char*>(samples.data()), width,
         samples.size() / (channels * width), channels, int(8 * sizeof(Integer))};
    is_good = internal::put_png(png, info, image, compression);
  }
  png_destroy_write_struct(&png, &info);
  return is_good ? bytes : std::string();
}

/// \ingroup PkgHLSCMTextureFiles
/// The same for an image of one to four channels.
inline std::string encode_PNG(const Texture_image& image,
                              const PNG_options& options = PNG_options())
{
  if((options.bits != 8 && options.bits != 16) || !(options.lowest <= options.highest)
     || image.texels.size() != image.width * image.height * image.channels)
    return {};
  return options.bits == 16
       ? encode_PNG(encode_values<std::uint16_t>(image, options.lowest, options.highest),
                    image.width, image.channels, options.compression)
       : encode_PNG(encode_values<std::uint8_t>(image, options.lowest, options.highest),
                    image.width, image.channels, options.compression);
}

/*!
\ingroup PkgHLSCMTextureFiles

Writes an image as PNG.

\return `false` if `os` did not take all, or, before anything is written, for the errors of
`encode_PNG()`.

`os` must not change bytes: open files with `std::ios::binary`.
*/
inline bool write_PNG(std::ostream& os, const Texture_image& image,
                      const PNG_options& options = PNG_options())
{
  const std::string bytes = encode_PNG(image, options);
  if(bytes.empty())
    return false;
  internal::Byte_output out(os);
  out.put(bytes);
  return out.finish();
}

/// \ingroup PkgHLSCMTextureFiles
/// Writes a PNG file: `false` also if it cannot be created or written; what it held before is lost
/// then.
inline bool write_PNG(const std::string& filename, const Texture_image& image,
                      const PNG_options& options = PNG_options())
{
  return internal::write_file(
    filename, [&](std::ostream& os) { return write_PNG(os, image, options); });
}

} // namespace IO
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_IO_PNG_H
