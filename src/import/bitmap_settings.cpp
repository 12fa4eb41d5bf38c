#include "import/bitmap_settings.h"

namespace sundog
{

namespace
{

constexpr double max_gamma = 100.0;

WrapMode read_wrap_mode(ObjectReader& reader, const char* name, WrapMode fallback)
{
    if (!reader.has(name)) return fallback;
    const std::string mode = reader.text(name, "");
    if (mode == "repeat") return WrapMode::repeat;
    if (mode == "mirror") return WrapMode::mirror;
    if (mode == "clamp") return WrapMode::clamp;
    if (mode == "zero") return WrapMode::zero;
    if (mode == "one") return WrapMode::one;
    throw SceneError(reader.where_of(name), "'" + std::string(name) + "' must be repeat, mirror, clamp, zero or one, got '" + mode + "'");
}

} // namespace

BitmapRequest read_bitmap_request(ObjectReader& reader)
{
    BitmapRequest request;
    request.file = reader.index().find_file(reader.text("filename", ""), reader.where_of("filename"));
    // What 3.x says by `raw`, 0.6 says by `gamma`: 1 is linear, -1 sRGB, 0 what the file is.
    request.gamma = reader.number("gamma", 0.0);
    if (request.gamma != -1.0 && !(request.gamma >= 0.0 && request.gamma <= max_gamma))
        throw SceneError(reader.where_of("gamma"), "'gamma' must be 1 (linear), -1 (sRGB), 0 (as the file says) or another exponent of up to 100");
    request.raw = reader.boolean("raw", request.gamma == 1.0);
    if (request.raw) request.gamma = 0.0;
    if (reader.has("channel")) request.channel = reader.text("channel", "");
    return request;
}

void read_wrap_modes(ObjectReader& reader, BitmapTexture& bitmap)
{
    const WrapMode both = read_wrap_mode(reader, "wrap_mode", WrapMode::repeat);
    bitmap.wrap_u = read_wrap_mode(reader, "wrap_mode_u", both);
    bitmap.wrap_v = read_wrap_mode(reader, "wrap_mode_v", both);
}

TextureFilter read_texture_filter(ObjectReader& reader)
{
    const std::string filter = reader.text("filter_type", "bilinear");
    if (filter == "nearest") return TextureFilter::nearest;
    if (filter == "ewa" || filter == "trilinear")
        reader.index().warn(reader.where_of("filter_type"), "filter '" + filter + "' is done as bilinear: many samples a pixel average the texture",
                            WarningKind::approximated);
    else if (filter != "bilinear")
        throw SceneError(reader.where_of("filter_type"), "'filter_type' must be nearest or bilinear, got '" + filter + "'");
    return TextureFilter::bilinear;
}

} // namespace sundog
