// Follows subpaths that are to be joined, and compares each vertex with plain C++.
#pragma once

#include "kernels/shading_fixture.h"
#include "shared/film.h"
#include "shared/regularization.h"
#include "support/plain_subpaths.h"

namespace sundog
{

class SubpathStage : public ShadingStage
{
protected:
    static constexpr Techniques vertex_merging = {0.02f, 50.0f, 0.02f, 1.0f, static_cast<float>(light_paths)};
    static constexpr Techniques connections_alone = {0.0f, 0.0f, 0.0f, 1.0f, static_cast<float>(light_paths)};
    static constexpr Techniques merging_alone = {0.02f, 50.0f, 0.02f, 0.0f, static_cast<float>(light_paths)};
    static constexpr Techniques gathering = {0.02f, 50.0f, 0.0f, 1.0f, static_cast<float>(light_paths)};

    std::vector<JoinableVertex> follow_camera_subpaths(const Techniques& techniques)
    {
        start_camera_paths();
        const std::size_t count = rays_.size();
        subpaths_ = upload(std::vector<Subpath>(count, Subpath{}));
        auto vertices = allocate<PathVertex>(count);
        std::vector<Subpath> before;
        std::vector<PathVertex> records;
        std::vector<JoinableVertex> joinable;
        const Kernel shade(device_, "shade_camera_subpath", "Shade", options_);
        follow_paths(
            [&](std::size_t items) {
                before = subpaths_.download();
                shade(items, scene_.surfaces(), plain_.camera, key_, rules(), techniques, Regularization{}, hits_, active_, active_count_,
                      rays_, paths_, subpaths_, radiance_, shadow_rays_, shadow_radiance_, vertices, flags_);
                next_subpaths_ = subpaths_.download();
                records = vertices.download();
            },
            [&](std::size_t item, uint path, const PlainVertex& vertex) {
                Doubt doubt;
                const PlainSubpathVertex expected =
                    plain_camera_subpath_vertex(plain_, vertex, before[path].weights, rules(), techniques, camera_numbers(path), doubt);
                if (!is_certain(vertex, expected, doubt)) return;
                expect_step(item, path, expected.next, expected.joins ? PATH_JOINS : 0);
                expect_leaving(path, expected);
                expect_shadow(path, expected.shadow, &got_shadow_radiance_[path]);
                expect_radiance(path, expected.radiance);
                if (!expected.joins) return;
                expect_vertex(path, vertex, expected, records[path], vertex.path.eta_scale);
                joinable.push_back({*expected.surface, *expected.side, records[path]});
            });
        return joinable;
    }

    std::vector<JoinableVertex> follow_light_subpaths(const Techniques& techniques)
    {
        const bool connects = techniques.connect > 0.0f, merges = techniques.merge > 0.0f;
        start_light_subpaths(techniques);
        left_photons_.clear();
        left_photon_vertices_.clear();
        const auto filter = upload(std::vector{plain_.filter});
        const auto pixels = pixels_by_path(plain_.camera.crop_width, plain_.camera.crop_height);
        const std::size_t slots = std::size_t(light_paths) * bounces;
        auto vertices = allocate<PathVertex>(slots);
        auto links = allocate<VertexLink>(slots);
        auto splat_deposits = allocate<Splat>(light_paths);
        auto photon_deposits = allocate<Photon>(light_paths);
        auto photon_vertex_deposits = allocate<PhotonVertex>(light_paths);
        uint first_slot = 0;
        std::vector<Subpath> before;
        std::vector<PathVertex> records;
        std::vector<VertexLink> got_links;
        std::vector<uint> last, next_last;
        std::vector<Splat> splats;
        std::vector<Photon> photons;
        std::vector<PhotonVertex> photon_vertices;
        std::vector<JoinableVertex> joinable;
        const Kernel shade(device_, "shade_light_subpath", "Shade", options_);
        follow_paths(
            [&](std::size_t items) {
                before = subpaths_.download();
                last = last_vertices_.download();
                shade(items, scene_.surfaces(), plain_.camera, filter, key_, rules(), techniques, light_paths, first_slot, hits_, active_,
                      active_count_, rays_, paths_, subpaths_, vertices, links, last_vertices_, shadow_rays_, splat_deposits,
                      photon_deposits, photon_vertex_deposits, flags_);
                next_subpaths_ = subpaths_.download();
                next_last = last_vertices_.download();
                records = vertices.download(first_slot, items);
                got_links = links.download();
                splats = splat_deposits.download();
                photons = photon_deposits.download();
                photon_vertices = photon_vertex_deposits.download();
                slots_before_ = first_slot;
                first_slot += static_cast<uint>(items);
            },
            [&](std::size_t item, uint path, const PlainVertex& vertex) {
                Doubt doubt;
                const PlainSubpathVertex expected =
                    plain_light_subpath_vertex(plain_, vertex, before[path], rules(), techniques, light_numbers(path), doubt);
                if (!is_certain(vertex, expected, doubt)) return;
                expect_step(item, path, expected.next, expected.leaves_record ? PATH_DEPOSIT : 0);
                expect_leaving(path, expected);
                expect_shadow(path, expected.shadow, expected.shadow ? &splats[item].radiance : nullptr);
                if (expected.splat) {
                    ASSERT_LT(splats[item].pixel, pixels.size());
                    EXPECT_EQ(pixels[splats[item].pixel], expected.splat->pixel) << "path " << path;
                    ++seen_["splats"];
                }
                const uint slot = slots_before_ + static_cast<uint>(item);
                const bool links_here = connects && expected.joins;
                EXPECT_EQ(next_last[path], links_here ? slot : last[path]) << "path " << path;
                if (connects) expect_link(path, got_links[slot], links_here, last[path], got_links);
                if (merges && expected.joins) {
                    left_photons_.push_back(photons[item]);
                    left_photon_vertices_.push_back(photon_vertices[item]);
                    expect_photon(path, vertex, *expected.surface, expected.flux, photons[item]);
                    expect_number("photon's vcm", path, photon_vertices[item].vcm, expected.at.vcm, weight_error);
                    expect_number("photon's vm", path, photon_vertices[item].vm, expected.at.vm, weight_error);
                    EXPECT_EQ(photon_vertices[item].slot, links_here ? slot : NO_VERTEX) << "path " << path;
                }
                if (!links_here) return;
                expect_vertex(path, vertex, expected, records[item], 1.0);
                joinable.push_back({*expected.surface, *expected.side, records[item]});
            });
        return joinable;
    }

    // What light subpaths have left for merging, in order. Of the last follow_light_subpaths.
    std::vector<Photon> left_photons_;
    std::vector<PhotonVertex> left_photon_vertices_;

    // Products of colours' errors with those of a squared distance and a cosine.
    static constexpr double weight_error = 2.0 * colour_error;

    static void expect_weights(const char* when, uint path, const PathWeights& got, const PlainWeights& expected)
    {
        SCOPED_TRACE(when);
        expect_number("vcm", path, got.vcm, expected.vcm, weight_error);
        expect_number("vc", path, got.vc, expected.vc, weight_error);
        expect_number("vm", path, got.vm, expected.vm, weight_error);
        expect_number("vc_specular", path, got.vc_specular, expected.vc_specular, weight_error);
    }

private:
    void start_light_subpaths(const Techniques& techniques)
    {
        reserve(light_paths);
        subpaths_ = allocate<Subpath>(light_paths);
        last_vertices_ = allocate<uint>(light_paths);
        Kernel(device_, "emit_light_subpaths", "Emit", options_)(light_paths, scene_.surfaces(), key_, techniques, light_paths, rays_,
                                                                 paths_, subpaths_, active_, last_vertices_);
        leave_some_out(light_paths);
    }

    void expect_leaving(uint path, const PlainSubpathVertex& expected) const
    {
        if (expected.next) expect_weights("leaving", path, next_subpaths_[path].weights, expected.leaving);
    }

    static void expect_vertex(uint path, const PlainVertex& vertex, const PlainSubpathVertex& expected, const PathVertex& got,
                              double eta_scale)
    {
        expect_near("vertex", path, got.position, expected.surface->position, point_error);
        expect_number("offset", path, got.offset, expected.surface->offset, 1e-6);
        expect_colour("vertex throughput", path, got.throughput, expected.throughput);
        EXPECT_EQ(got.depth, vertex.path.depth) << "path " << path;
        expect_number("squared indices", path, got.eta_scale, eta_scale, 1e-6);
        expect_number("merge", path, got.merge, expected.merge, 1e-6);
        expect_weights("at the vertex", path, got.weights, expected.at);
    }

    static void expect_link(uint path, const VertexLink& got, bool linked, uint previous, const std::vector<VertexLink>& links)
    {
        EXPECT_EQ(got.rank, !linked ? 0 : previous == NO_VERTEX ? 1 : links[previous].rank + 1) << "path " << path;
        if (!linked) return;
        EXPECT_EQ(got.previous, previous) << "path " << path;
    }

    Buffer<Subpath> subpaths_;
    Buffer<uint> last_vertices_;
    std::vector<Subpath> next_subpaths_;
    uint slots_before_ = 0;
};

} // namespace sundog
