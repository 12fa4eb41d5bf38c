#include "app/failure.h"

#include <new>

namespace sundog {

Failure failure_of(const std::exception_ptr& exception)
{
    try {
        std::rethrow_exception(exception);
    } catch (const Error& error) {
        return {error.status(), error.what()};
    } catch (const std::bad_alloc&) {
        return {ExitStatus::internal_error, "out of host memory; use a smaller film, fewer photons or a smaller scene"};
    } catch (const std::exception& error) {
        return {ExitStatus::internal_error, std::string("internal error: ") + error.what()};
    } catch (...) {
        return {ExitStatus::internal_error, "internal error"};
    }
}

} // namespace sundog
