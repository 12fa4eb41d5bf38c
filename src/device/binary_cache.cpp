#include "device/binary_cache.h"

#include "base/atomic_file.h"
#include "base/hash.h"
#include "base/log.h"
#include "device/kernel.h"

#include <fmt/format.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace sundog
{

namespace fs = std::filesystem;

namespace
{

struct FileHeader {
    char magic[8];
    std::uint64_t bytes;
    std::uint64_t hash_high;
    std::uint64_t hash_low;
};

constexpr char magic[8] = {'S', 'U', 'N', 'D', 'O', 'G', 'B', '1'};

FileHeader header_of(std::string_view binary)
{
    FileHeader header;
    std::memcpy(header.magic, magic, sizeof magic);
    const Hash hash = Hash().append(binary);
    header.bytes = binary.size();
    header.hash_high = hash.high();
    header.hash_low = hash.low();
    return header;
}

fs::path file_of(const std::string& key)
{
    return fs::path(program_cache_directory()) / (key + ".bin");
}

std::string environment(const char* name)
{
    const char* value = std::getenv(name);
    return value ? value : "";
}

// The first failure stands for those of all programs.
void warn_once(const std::string& problem)
{
    static std::atomic<bool> warned = false;
    if (warned.exchange(true)) return;
    log_warning(fmt::format("kernels are not kept for other runs: {} (SUNDOG_CACHE_DIR=FOLDER chooses another place)", problem));
}

} // namespace

std::string program_cache_directory()
{
    if (auto own = environment("SUNDOG_CACHE_DIR"); !own.empty()) return own;
    if (auto shared = environment("XDG_CACHE_HOME"); !shared.empty()) return (fs::path(shared) / "sundog").string();
    if (auto home = environment("HOME"); !home.empty()) return (fs::path(home) / ".cache" / "sundog").string();
    return {};
}

std::optional<std::string> load_cached_binary(const std::string& key)
{
    if (program_cache_directory().empty()) return {};
    std::error_code failed;
    if (!fs::is_regular_file(file_of(key), failed)) return {}; // a folder would open, and fail to be read
    std::ifstream file(file_of(key), std::ios::binary);
    if (!file) return {};
    const std::string content((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (content.size() >= sizeof(FileHeader)) {
        const std::string_view binary = std::string_view(content).substr(sizeof(FileHeader));
        const FileHeader expected = header_of(binary);
        if (std::memcmp(&expected, content.data(), sizeof expected) == 0) return std::string(binary);
    }
    log_debug(fmt::format("cached program {} is damaged; it will be built anew", file_of(key).string()));
    return {};
}

void store_cached_binary(const std::string& key, std::string_view binary)
{
    if (program_cache_directory().empty()) return;
    const fs::path target = file_of(key);
    const FileHeader header = header_of(binary);
    try {
        fs::create_directories(target.parent_path());
        AtomicFile file(target);
        file.write({reinterpret_cast<const char*>(&header), sizeof header});
        file.write(binary);
        file.commit();
    } catch (const std::exception& error) {
        warn_once(error.what());
    }
}

void remove_cached_binary(const std::string& key)
{
    std::error_code ignored;
    if (!program_cache_directory().empty()) fs::remove(file_of(key), ignored);
}

} // namespace sundog
