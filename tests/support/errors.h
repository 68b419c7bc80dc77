// What a call that must fail says.
#pragma once

#include "meshtween/core/error.h"

#include <gtest/gtest.h>

#include <string>

namespace meshtween {

// The message of the Error that `call` throws; fails the test where it throws none, or one of another kind.
template <typename Call>
std::string message_of(ErrorKind kind, const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        EXPECT_EQ(static_cast<int>(error.kind()), static_cast<int>(kind)) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "no error";
    return {};
}

} // namespace meshtween
