#include "app/output_conflicts.h"

#include "base/errors.h"
#include "base/output_path.h"

#include <fmt/format.h>

namespace sundog {

void check_outputs_apart(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs)
{
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        for (const NamedFile& input : inputs)
            if (are_one_file(output->path, input.path))
                throw UsageError(fmt::format("{} {} would overwrite {}; choose another name", output->name, output->path.string(), input.name));
        for (auto other = outputs.begin(); other != output; ++other)
            if (are_one_file(output->path, other->path))
                throw UsageError(fmt::format("{} {} and {} {} are one file; choose another name for one of them", other->name, other->path.string(), output->name,
                                             output->path.string()));
    }
}

} // namespace sundog
