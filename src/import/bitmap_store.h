// Image files of a scene: each read once, all of them within the budget for textures.
#pragma once

#include "import/bitmap.h"
#include "import/scene_index.h"
#include "import/texture_budget.h"

#include <map>

namespace sundog
{

class BitmapStore
{
public:
    BitmapStore(const SceneIndex& index, std::uint64_t budget) : index_(index), budget_(budget) {}

    // Bitmaps that are read later may halve it, in place. Throws SceneError at `where` for a file that cannot be read.
    std::shared_ptr<const TexelImage> bitmap(const BitmapRequest& request, const SourceLocation& where);
    // Within the budget by itself.
    std::shared_ptr<const TexelImage> environment(const BitmapRequest& request, const SourceLocation& where);

    // Width over height in the file.
    double aspect(const TexelImage& bitmap) const;

    // Once all are there: a warning for each bitmap that does not have its file's size.
    void warn_of_scaled_down() const;

private:
    const SceneIndex& index_;
    std::uint64_t budget_;
    std::map<BitmapRequest, std::size_t> known_; // places in bitmaps_
    std::vector<BudgetedBitmap> bitmaps_;
};

} // namespace sundog
