// UpAxis: which of a file's axes points up.
#pragma once

namespace ringlet {

enum class UpAxis { y, z };

}  // namespace ringlet
