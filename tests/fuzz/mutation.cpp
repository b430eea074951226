#include "fuzz/mutation.h"

#include <algorithm>
#include <fstream>

namespace hooke {
namespace {

constexpr std::size_t max_bytes = 20'000;
constexpr std::string_view numbers[] = {"0",          "-1",
                                        "1e400",      "-1e400",
                                        "1e308",      "1e-320",
                                        "nan",        "inf",
                                        "-0.0",       "0.1",
                                        "2147483648", "4294967296",
                                        "1e18",       "18446744073709551616",
                                        "5e-324",     "3",
                                        "100000",     "-9223372036854775809"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

std::string Mutator::next() {
  std::string bytes = seeds_[below(seeds_.size())];
  for (std::size_t changes = 1 + below(6); changes > 0; --changes) change(bytes);
  if (bytes.size() > max_bytes) bytes.resize(max_bytes);
  return bytes;
}

void Mutator::change(std::string& bytes) {
  const std::size_t at = below(bytes.size() + 1), length = std::min(bytes.size() - at, 1 + below(64));
  switch (below(9)) {
    case 0:
      if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
      break;
    case 1:
      if (at < bytes.size()) bytes[at] = static_cast<char>(below(256));
      break;
    case 2:
      bytes.erase(at, length);
      break;
    case 3:
      bytes.insert(below(bytes.size() + 1), bytes.substr(at, length));
      break;
    case 4:
      bytes.insert(at, words_[below(words_.size())]);
      break;
    case 5:
      bytes.resize(at);
      break;
    case 6: {
      const std::string& other = seeds_[below(seeds_.size())];
      bytes.replace(at, length, other.substr(below(other.size() + 1), below(400)));
      break;
    }
    default:
      replace_number(bytes);
  }
}

// The number at or after a random position, if there is one.
void Mutator::replace_number(std::string& bytes) {
  const auto begin = std::find_if(bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size() + 1)), bytes.end(), is_digit);
  const auto end = std::find_if_not(begin, bytes.end(), [](char c) { return is_digit(c) || c == '.' || c == 'e' || c == '-'; });
  if (begin != end) bytes.replace(begin, end, numbers[below(std::size(numbers))]);
}

std::vector<std::string> read_dictionary(const std::string& file) {
  std::vector<std::string> words;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find('"'), last = line.rfind('"');
    if (line.starts_with('#') || first == last || first == std::string::npos) continue;
    std::string word;
    for (std::size_t i = first + 1; i < last; ++i) {
      if (line[i] == '\\' && i + 3 < last + 1 && line[i + 1] == 'x') {
        word += static_cast<char>(std::stoi(line.substr(i + 2, 2), nullptr, 16));
        i += 3;
      } else if (line[i] == '\\' && i + 1 < last) {
        word += line[++i];
      } else {
        word += line[i];
      }
    }
    words.push_back(word);
  }
  return words;
}

}  // namespace hooke
