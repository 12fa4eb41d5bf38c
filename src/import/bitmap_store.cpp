#include "import/bitmap_store.h"

namespace sundog
{

std::shared_ptr<const TexelImage> BitmapStore::bitmap(const BitmapRequest& request, const SourceLocation& where)
{
    if (const auto found = known_.find(request); found != known_.end()) return bitmaps_[found->second].image;
    LoadedBitmap loaded = load_bitmap(request, where, budget_);
    if (loaded.repairs.any())
        index_.warn(where,
                    "values of '" + request.file.string() + "' that are not finite were replaced, NaN by 0 and infinity by 65504, and those beyond 1e30 by 1e30 (" +
                        loaded.repairs.text() + ")",
                    WarningKind::approximated);
    known_.emplace(request, bitmaps_.size());
    bitmaps_.push_back({std::make_shared<TexelImage>(std::move(loaded.image)), loaded.file_width, loaded.file_height, where});
    const auto image = bitmaps_.back().image;
    fit_texture_budget(bitmaps_, budget_);
    return image;
}

std::shared_ptr<const TexelImage> BitmapStore::environment(const BitmapRequest& request, const SourceLocation& where)
{
    LoadedBitmap loaded = load_environment(request, where, budget_);
    if (loaded.repairs.any())
        index_.warn(where, "values of '" + request.file.string() + "' that are negative or not finite count as 0 (" + loaded.repairs.text() + ")",
                    WarningKind::approximated);
    if (loaded.was_halved())
        index_.warn(scaled_down_warning(where, "environment", loaded.file_width, loaded.file_height, loaded.image, budget_));
    return std::make_shared<const TexelImage>(std::move(loaded.image));
}

double BitmapStore::aspect(const TexelImage& bitmap) const
{
    for (const BudgetedBitmap& known : bitmaps_)
        if (known.image.get() == &bitmap) return static_cast<double>(known.file_width) / known.file_height;
    return 1.0;
}

void BitmapStore::warn_of_scaled_down() const
{
    for (const BudgetedBitmap& bitmap : bitmaps_)
        if (bitmap.image->width != bitmap.file_width || bitmap.image->height != bitmap.file_height)
            index_.warn(scaled_down_warning(bitmap.where, "bitmap", bitmap.file_width, bitmap.file_height, *bitmap.image, budget_));
}

} // namespace sundog
