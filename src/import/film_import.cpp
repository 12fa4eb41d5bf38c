#include "import/sensor_import.h"

namespace sundog
{

namespace
{

constexpr int max_side = 65536; // pixels
constexpr long long max_pixels = 1LL << 28;

ReconstructionFilter read_filter(ObjectReader& reader)
{
    const std::string type = reader.type();
    ReconstructionFilter filter;
    if (type == "box") {
        filter.kind = FilterKind::box;
        filter.radius = static_cast<float>(reader.positive("radius", 0.5));
    } else if (type == "tent") {
        filter.kind = FilterKind::tent;
        filter.radius = static_cast<float>(reader.positive("radius", 1.0));
    } else if (type == "gaussian") {
        filter.kind = FilterKind::gaussian;
        filter.stddev = static_cast<float>(reader.positive("stddev", 0.5));
        filter.radius = 4.0f * filter.stddev;
    } else if (type == "mitchell") {
        filter.kind = FilterKind::mitchell;
        filter.b = static_cast<float>(reader.number_between("b", 1.0 / 3.0, -10.0, 10.0));
        filter.c = static_cast<float>(reader.number_between("c", 1.0 / 3.0, -10.0, 10.0));
    } else if (type == "catmullrom") {
        filter.kind = FilterKind::mitchell; // of which it is the case B = 0, C = 1/2
        filter.b = 0.0f;
        filter.c = 0.5f;
    } else if (type == "lanczos") {
        filter.kind = FilterKind::lanczos;
        filter.radius = static_cast<float>(reader.integer("lobes", 3));
        if (!(filter.radius >= 1.0f)) throw SceneError(reader.where_of("lobes"), "a lanczos filter must have at least one lobe");
    } else {
        reader.unsupported("box, tent, gaussian, mitchell, catmullrom, lanczos");
    }
    if (!(filter.radius >= 1e-3f && filter.radius <= 32.0f))
        throw SceneError(reader.where(), "the radius of a reconstruction filter must be between 0.001 and 32 pixels");
    reader.finish();
    return filter;
}

int read_side(ObjectReader& reader, const char* name, int fallback)
{
    const int side = reader.integer(name, fallback);
    if (side < 1 || side > max_side)
        throw SceneError(reader.where_of(name), std::string(name) + " of the film must be between 1 and " + std::to_string(max_side) +
                                                    " pixels, got " + std::to_string(side));
    return side;
}

// The crop must lie inside of the film along one axis.
void check_crop(ObjectReader& reader, const char* offset_name, const char* size_name, int offset, int size, int film)
{
    if (offset < 0) throw SceneError(reader.where_of(offset_name), std::string(offset_name) + " must be >= 0");
    if (size < 1) throw SceneError(reader.where_of(size_name), std::string(size_name) + " must be >= 1");
    if (offset <= film - size) return;
    const char* name = reader.has(size_name) ? size_name : offset_name;
    throw SceneError(reader.where_of(name), "the crop ends at " + std::to_string(static_cast<long long>(offset) + size) +
                                                ", outside of the film's " + std::to_string(film) + " pixels");
}

// Films differ in the file that they write, which the command line chooses here, and mfilm in its default size.
void read_type(ObjectReader& reader, Film& film)
{
    const std::string type = reader.type();
    const auto taken_as_hdrfilm = [&](const std::string& reason) {
        reader.index().warn(reader.where(), "film '" + type + "' is taken as hdrfilm: " + reason, WarningKind::approximated);
    };
    if (type == "ldrfilm") {
        taken_as_hdrfilm("exposure is chosen when the image is written");
    } else if (type == "tiledhdrfilm") {
        taken_as_hdrfilm("the whole image is kept in memory");
    } else if (type == "mfilm") {
        taken_as_hdrfilm("the format of the file is chosen by the name of the output");
        film.width = film.height = 1;
    } else if (type == "specfilm") {
        throw SceneError(
            reader.where(),
            "film plugin 'specfilm' is not supported: light has red, green and blue here, not bands of wavelengths; use hdrfilm");
    } else if (type != "hdrfilm") {
        reader.unsupported("hdrfilm, ldrfilm, tiledhdrfilm, mfilm");
    }
}

} // namespace

Film import_film(ObjectReader& reader)
{
    Film film;
    film.where = reader.where();
    read_type(reader, film);
    film.width = read_side(reader, "width", film.width);
    film.height = read_side(reader, "height", film.height);
    if (static_cast<long long>(film.width) * film.height > max_pixels)
        throw SceneError(reader.where_of("width"),
                         "the film has more than 2^28 pixels: " + std::to_string(film.width) + " x " + std::to_string(film.height));
    film.crop_x = reader.integer("crop_offset_x", 0);
    film.crop_y = reader.integer("crop_offset_y", 0);
    film.crop_width = reader.integer("crop_width", film.width - std::max(film.crop_x, 0));
    film.crop_height = reader.integer("crop_height", film.height - std::max(film.crop_y, 0));
    check_crop(reader, "crop_offset_x", "crop_width", film.crop_x, film.crop_width, film.width);
    check_crop(reader, "crop_offset_y", "crop_height", film.crop_y, film.crop_height, film.height);

    if (const auto filter = reader.single("rfilter")) {
        ObjectReader filter_reader(*filter->object, reader.index());
        film.filter = read_filter(filter_reader);
    }
    // Samples always come from beyond the border too, which is what true asks for.
    if (!reader.boolean("sample_border", true))
        reader.index().warn(reader.where_of("sample_border"),
                            "sample_border is taken as true: pixels at the border get samples from both of its sides", WarningKind::approximated);
    for (const char* name : {"file_format", "pixel_format", "component_format", "banner", "attach_log", "high_quality_edges", "compensate",
                             "label_font", "gamma", "exposure", "tonemap_method", "key", "burn", "digits", "variable"})
        reader.ignore(name, "how the image is written is chosen on the command line");
    reader.finish();
    return film;
}

} // namespace sundog
