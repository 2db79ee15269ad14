// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_TEXT_SCANNER_H
#define HLSCM_PROGRAM_TEXT_SCANNER_H

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

namespace hlscm {

/// Reads words and numbers from a range of bytes, either within the current line or across lines.
class Text_scanner
{
public:
  Text_scanner(const char* begin, const char* end)
    : m_position(begin), m_line_end(begin), m_end(end)
  {}

  const char* position() const { return m_position; }
  std::size_t line_number() const { return m_line; }

  /// Goes to the next line; false at the end of the text.
  bool next_line()
  {
    m_position = m_line_end;
    if(m_line > 0 && m_position < m_end) {
      ++m_position; // the line feed
    }
    if(m_position >= m_end) {
      return false;
    }
    ++m_line;
    const void* feed = std::memchr(m_position, '\n', std::size_t(m_end - m_position));
    m_line_end = feed != nullptr ? static_cast<const char*>(feed) : m_end;
    return true;
  }

  /// Goes to the next line with content; what follows `comment` in a line is no content.
  bool next_content_line(char comment = '#')
  {
    while(next_line()) {
      const void* mark = std::memchr(m_position, comment, std::size_t(m_line_end - m_position));
      m_content_end = mark != nullptr ? static_cast<const char*>(mark) : m_line_end;
      if(!is_line_done()) {
        return true;
      }
    }
    m_content_end = m_end;
    return false;
  }

  /// Lets the following words and numbers be read across the ends of lines, up to the end of the
  /// text.
  void ignore_lines() { m_content_end = m_line_end = m_end; }

  /// Whether only white space is left.
  bool is_line_done()
  {
    skip_space();
    return m_position == m_content_end;
  }

  /// Whether the line ends with the text instead of a line feed.
  bool is_last_line_open() const { return m_line_end == m_end; }

  /// The characters up to the next white space; empty if none is left.
  std::string_view word()
  {
    skip_space();
    const char* begin = m_position;
    while(m_position < m_content_end && !is_space(*m_position)) {
      ++m_position;
    }
    return std::string_view(begin, std::size_t(m_position - begin));
  }

  /// The next word as a number ("nan" and "inf" are numbers); nothing if it is not one.
  std::optional<double> number()
  {
    const std::string_view text = without_plus(word());
    double value = 0;
    const std::from_chars_result result =
        std::from_chars(text.data(), text.data() + text.size(), value);
    if(text.empty() || result.ptr != text.data() + text.size()) {
      return std::nullopt;
    }
    if(result.ec == std::errc::result_out_of_range) {
      return std::strtod(std::string(text).c_str(), nullptr); // infinite, or (almost) zero
    }
    return value;
  }

  std::optional<long long> integer() { return to_integer(word()); }

  static std::optional<long long> to_integer(std::string_view text)
  {
    text = without_plus(text);
    long long value = 0;
    const std::from_chars_result result =
        std::from_chars(text.data(), text.data() + text.size(), value);
    if(text.empty() || result.ec != std::errc() || result.ptr != text.data() + text.size()) {
      return std::nullopt;
    }
    return value;
  }

private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  static std::string_view without_plus(std::string_view text)
  {
    return text.size() > 1 && text[0] == '+' ? text.substr(1) : text;
  }

  void skip_space()
  {
    while(m_position < m_content_end && is_space(*m_position)) {
      ++m_position;
    }
  }

  const char* m_position;
  const char* m_line_end;                 // of the whole line
  const char* m_content_end = m_line_end; // without a comment
  const char* m_end;
  std::size_t m_line = 0;
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_TEXT_SCANNER_H
