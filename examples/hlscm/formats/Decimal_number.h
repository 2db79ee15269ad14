// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_DECIMAL_NUMBER_H
#define HLSCM_PROGRAM_DECIMAL_NUMBER_H

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

namespace hlscm {

inline bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A number read digit by digit: (-1)^negative * digits * 10^exponent.
struct Decimal_digits
{
  std::uint64_t digits = 0;
  int number_of_digits = 0; ///< without the zeros in front
  int exponent = 0;
  bool is_negative = false;
  bool is_number = false; ///< there is a digit at least

  /// Reads from `p` on and moves it behind the number.
  void read(const char*& p, const char* end)
  {
    is_negative = p != end && *p == '-';
    p += p != end && (*p == '-' || *p == '+');
    read_digits(p, end);
    if(p != end && *p == '.') {
      const char* point = ++p;
      read_digits(p, end);
      exponent = int(point - p);
    }
    if(is_number && p != end && (*p == 'e' || *p == 'E')) {
      read_exponent(p, end);
    }
  }

  /// Its value if one rounding gives it: both factors are exact then, and so is what C++ would
  /// read.
  std::optional<double> exact_value() const
  {
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                    1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                    1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    constexpr std::uint64_t largest = std::uint64_t(1) << 53;
    if(!is_number || number_of_digits > 19 || digits > largest || exponent < -22 || exponent > 22) {
      return std::nullopt;
    }
    const double value =
        exponent < 0 ? double(digits) / powers[-exponent] : double(digits) * powers[exponent];
    return is_negative ? -value : value;
  }

private:
  void read_digits(const char*& p, const char* end)
  {
    for(; p != end && is_digit(*p); ++p) {
      is_number = true;
      digits = 10 * digits + std::uint64_t(*p - '0'); // of no use beyond 19 digits
      number_of_digits += number_of_digits > 0 || *p != '0';
    }
  }

  void read_exponent(const char*& p, const char* end)
  {
    const char* q = p + 1;
    const bool is_divisor = q != end && *q == '-';
    q += q != end && (*q == '-' || *q == '+');
    is_number = q != end && is_digit(*q);
    int power = 0;
    for(; q != end && is_digit(*q); ++q) {
      power = power < 1000 ? 10 * power + (*q - '0') : power;
    }
    exponent += is_divisor ? -power : power;
    p = q;
  }
};

/// The number that a text is, or nothing; "nan" and "inf" are numbers, and a plus sign is allowed.
inline std::optional<double> to_number(std::string_view text)
{
  if(text.size() > 1 && text[0] == '+' && text[1] != '-') {
    text.remove_prefix(1);
  }
  double value = 0;
  const char* end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if(text.empty() || result.ptr != end) {
    return std::nullopt;
  }
  if(result.ec == std::errc::result_out_of_range) {
    return std::strtod(std::string(text).c_str(), nullptr); // infinite, or (almost) zero
  }
  return value;
}

/// The same for a whole number.
inline std::optional<long long> to_integer(std::string_view text)
{
  if(text.size() > 1 && text[0] == '+' && text[1] != '-') {
    text.remove_prefix(1);
  }
  long long value = 0;
  const char* end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if(text.empty() || result.ec != std::errc() || result.ptr != end) {
    return std::nullopt;
  }
  return value;
}

} // namespace hlscm

#endif // HLSCM_PROGRAM_DECIMAL_NUMBER_H
