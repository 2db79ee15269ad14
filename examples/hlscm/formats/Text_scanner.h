// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_TEXT_SCANNER_H
#define HLSCM_PROGRAM_TEXT_SCANNER_H

#include "formats/Decimal_number.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

namespace hlscm {

/// Reads words and numbers from a range of bytes, either within the current line or across lines.
///
/// A line ends with a line feed, with a carriage return, or with both in this order.
class Text_scanner
{
public:
  Text_scanner(const char* begin, const char* end)
    : m_position(begin), m_line_end(begin), m_content_end(begin), m_end(end),
      m_feed(find('\n', begin)), m_return(find('\r', begin))
  {}

  Text_scanner(const Text_scanner&) = delete;
  Text_scanner& operator=(const Text_scanner&) = delete;

  const char* position() const { return m_position; }
  /// Where the current line ends, and the next one does not begin yet.
  const char* line_end() const { return m_line_end; }
  /// The number of the line, from 1; of several lines that are one, that of the first.
  std::size_t line_number() const { return m_first_line; }

  /// Goes to the next line; false at the end of the text.
  bool next_line()
  {
    m_position = m_line_end;
    if(m_line > 0 && m_position < m_end) {
      ++m_position; // what ends the line
    }
    if(m_position >= m_end) {
      return false;
    }
    m_first_line = ++m_line;
    m_feed = m_feed < m_position ? find('\n', m_position) : m_feed;
    m_return = m_return < m_position ? find('\r', m_position) : m_return;
    m_line_end = m_return < m_feed && m_return + 1 != m_feed ? m_return : m_feed;
    m_content_end = m_line_end;
    return true;
  }

  /// Goes to the next line with content; what follows `comment` in a line is no content.
  bool next_content_line(char comment = '#')
  {
    while(next_line()) {
      end_content_at(comment);
      if(!is_line_done()) {
        return true;
      }
    }
    m_content_end = m_end;
    return false;
  }

  /// The same where a backslash at the end of a line continues it.
  bool next_continued_line()
  {
    if(!next_content_line()) {
      return false;
    }
    if(is_continued()) {
      join_lines();
    }
    return true;
  }

  /// Lets the following words and numbers be read across the ends of lines, up to the end of the
  /// text.
  void ignore_lines() { m_content_end = m_line_end = m_end; }

  /// Passes over what is left of the line.
  void skip_line() { m_position = m_content_end; }

  /// Whether only white space is left.
  bool is_line_done()
  {
    skip_space();
    return m_position == m_content_end;
  }

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

  /// What is left of the line but white space at both ends, a comment included.
  std::string_view rest()
  {
    const bool is_joined = m_content_end == m_joined.data() + m_joined.size();
    const char* end = is_joined ? m_content_end : m_line_end;
    skip_space();
    while(end > m_position && is_space(end[-1])) {
      --end;
    }
    return std::string_view(m_position, std::size_t(end - m_position));
  }

  /// The next word as a number ("nan" and "inf" are numbers); nothing if it is not one.
  std::optional<double> number()
  {
    skip_space();
    const char* p = m_position;
    Decimal_digits decimal;
    decimal.read(p, m_content_end);
    if(p == m_content_end || is_space(*p)) {
      if(const auto value = decimal.exact_value()) {
        m_position = p;
        return value;
      }
    }
    return to_number(word());
  }

  std::optional<long long> integer() { return to_integer(word()); }

private:
  const char* find(char c, const char* from) const
  {
    const void* found = from < m_end ? std::memchr(from, c, std::size_t(m_end - from)) : nullptr;
    return found != nullptr ? static_cast<const char*>(found) : m_end;
  }

  void end_content_at(char comment)
  {
    const void* mark = std::memchr(m_position, comment, std::size_t(m_line_end - m_position));
    m_content_end = mark != nullptr ? static_cast<const char*>(mark) : m_line_end;
  }

  // Whether the content ends with a backslash, which is no part of it then.
  bool is_continued()
  {
    const char* last = m_content_end;
    while(last > m_position && is_space(last[-1])) {
      --last;
    }
    if(last == m_position || last[-1] != '\\') {
      return false;
    }
    m_content_end = last - 1;
    return true;
  }

  void join_lines()
  {
    const std::size_t first = m_line;
    std::string joined(m_position, m_content_end);
    for(bool goes_on = true; goes_on && next_line();) {
      end_content_at('#');
      goes_on = is_continued();
      joined.append(1, ' ').append(m_position, m_content_end);
    }
    m_first_line = first;
    m_joined = std::move(joined);
    m_position = m_joined.data();
    m_content_end = m_joined.data() + m_joined.size();
  }

  void skip_space()
  {
    while(m_position < m_content_end && is_space(*m_position)) {
      ++m_position;
    }
  }

  const char* m_position;
  const char* m_line_end;    // of the whole line
  const char* m_content_end; // without a comment
  const char* m_end;
  const char* m_feed;   // the first line feed that is not before the line, or the end
  const char* m_return; // the first carriage return
  std::size_t m_line = 0;
  std::size_t m_first_line = 0;
  std::string m_joined; // lines that are one
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_TEXT_SCANNER_H
