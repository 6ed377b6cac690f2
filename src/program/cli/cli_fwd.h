// The types of CLI11 that headers of the program name. A file that does more than pass them on includes
// CLI/CLI.hpp, which takes seconds to compile.
#pragma once

namespace CLI {
class App;
class Option;
class ParseError;
class Validator;
}  // namespace CLI
