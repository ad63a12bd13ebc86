#include "report_page.hpp"

#include <charconv>
#include <map>
#include <stdexcept>

#include "report_data.hpp"
#include "store/digest.hpp"

namespace epicyclic::app {

namespace {

/// As a content security policy names what stands in the page.
std::string hash_source(std::string_view text) {
  const std::string hex = store::sha256_hex(text);
  std::string bytes;
  for (std::size_t k = 0; k + 1 < hex.size(); k += 2) {
    unsigned value = 0;
    std::from_chars(hex.data() + k, hex.data() + k + 2, value, 16);
    bytes += static_cast<char>(value);
  }
  return "'sha256-" + base64(bytes) + "'";
}

}  // namespace

std::string html_text(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return safe;
}

std::string report_page(std::string_view title, std::string_view version, std::string_view data, PageUse use) {
  const std::string policy = "default-src 'none'; script-src " + hash_source(browser::plot) + " " +
                             hash_source(browser::program) + "; style-src " + hash_source(browser::style) +
                             "; base-uri 'none'; form-action 'none'" +
                             (use == PageUse::served ? "; connect-src 'self'" : "");
  const std::string_view requests = use == PageUse::served ? "The server on this machine computes and sends its data."
                                                           : "This file is complete in itself: it makes no request.";
  const std::string safe_title = html_text(title);
  const std::map<std::string_view, std::string_view> parts = {
      {"POLICY", policy}, {"TITLE", safe_title},   {"VERSION", version},          {"STYLE", browser::style},
      {"DATA", data},     {"PLOT", browser::plot}, {"PROGRAM", browser::program}, {"REQUESTS", requests},
  };
  // Once from left to right: what is put in is not read again.
  std::string text;
  std::string_view rest = browser::page;
  for (std::size_t at = rest.find('@'); at != std::string_view::npos; at = rest.find('@')) {
    const std::size_t end = rest.find('@', at + 1);
    const auto part = parts.find(rest.substr(at + 1, end == std::string_view::npos ? 0 : end - at - 1));
    if (part == parts.end()) throw std::logic_error("the template of a report has a part that is not known");
    text += rest.substr(0, at);
    text += part->second;
    rest.remove_prefix(end + 1);
  }
  text += rest;
  return text;
}

}  // namespace epicyclic::app
