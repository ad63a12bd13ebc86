// The standard streams: data go to stdout, messages to stderr.
//
// Control characters, such as those in a text of an input, are escaped on both: a terminal shows them and does not obey
// them.
//
// A failed write to stdout is an I/O error: closed, full, or a reader that has gone. It is reported and has an exit
// code of its own, like a file that cannot be written. A failed write to stderr is ignored: no result depends on it.
#pragma once

#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace epicyclic::app {

/// To be called before any file is opened: a stream that was closed at the start would else be the journal, and words
/// would be written into it. Then too neither the end of a reader nor a limit on the size of files ends the program.
void secure_streams();

/// @throws OutputError
void write_data(std::string_view text);

void write_words(std::string_view text) noexcept;

/// Data, on stdout.
/// @throws OutputError
template <class... Values>
void print(fmt::format_string<Values...> format, Values&&... values) {
  write_data(fmt::format(format, std::forward<Values>(values)...));
}

/// Words, on stderr.
template <class... Values>
void print_message(fmt::format_string<Values...> format, Values&&... values) {
  write_words(fmt::format(format, std::forward<Values>(values)...));
}

}  // namespace epicyclic::app
