// What an exception means to the user.
#pragma once

#include "base/errors.h"

#include <exception>
#include <string>

namespace sundog {

struct Failure {
    ExitStatus status;
    std::string message;
};

Failure failure_of(const std::exception_ptr& exception);

} // namespace sundog
