#include "base/make_rule.hh"

#include <filesystem>

namespace lgiw {
namespace {

std::string escaped(const std::string& path) {
  std::string text;
  for (const char c : path) {
    if (c == ' ' || c == '#' || c == ':') text += '\\';
    if (c == '$') text += '$';
    if (c == '=')
      text += "$(equals_sign)";  // a line with one before its colon would set a variable
    else
      text += c;
  }
  return text;
}

}  // namespace

std::string make_rule(const std::string& target, const std::vector<std::string>& inputs) {
  std::string rule = escaped(target) + ":", alone;
  for (const std::string& path : inputs) {
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(path, unknown)) continue;
    rule += " \\\n  " + escaped(path);
    alone += escaped(path) + ":\n";
  }
  return "equals_sign := =\n" + rule + "\n\n" + alone;
}

}  // namespace lgiw
