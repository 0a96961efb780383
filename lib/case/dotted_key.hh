// Keys as users name them, `soil.friction_angle` or `gauges.0.x`, and where they stand.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace lgiw {

/// The place of `key` or of its nearest parent that has one; the root is "".
std::string nearest_place(const std::map<std::string, std::string>& places, std::string key);

/// The word with the smallest Levenshtein distance to `word`; the first of equals.
std::string nearest_word(const std::string& word, const std::vector<std::string>& words);

/// So many significant digits, no trailing zeros; a coordinate wants ten.
std::string number_text(double value, int digits = 6);

}  // namespace lgiw
