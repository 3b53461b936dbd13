// Tests: A configuration becomes the types of the physics.
#include "studies/settings/trials.hpp"
#include "tests/message_of.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::string_view given = "on the command line";

Configuration with(std::initializer_list<std::pair<const char*, const char*>> values) {
  Configuration configuration;
  for (const auto& [key, value] : values) configuration.set(key, value, given);
  return configuration;
}

double fried_parameter(const Configuration& configuration) {
  return seeing_of(configuration, telescope_of(configuration)).fried_parameter;
}

TEST(Settings, TheDefaultsAreThoseOfTheTypes) {
  const Configuration configuration;
  const SensorDesign design = design_of(configuration);
  const SensorDesign expected;
  EXPECT_EQ(design.planes, expected.planes);
  EXPECT_EQ(design.detector.pupil_pixels, expected.detector.pupil_pixels);
  EXPECT_EQ(design.detector.window, expected.detector.window);
  EXPECT_EQ(design.reconstruction.max_loops, expected.reconstruction.max_loops);
  EXPECT_EQ(design.reconstruction.tolerance, expected.reconstruction.tolerance);
  EXPECT_EQ(design.reconstruction.stopping, expected.reconstruction.stopping);
  EXPECT_EQ(design.reconstruction.window, expected.reconstruction.window);
  EXPECT_EQ(design.reconstruction.outside, expected.reconstruction.outside);
  EXPECT_EQ(design.reconstruction.unwrapping, expected.reconstruction.unwrapping);
  EXPECT_EQ(telescope_of(configuration).diameter, Telescope().diameter);
  EXPECT_EQ(telescope_of(configuration).wavelength, Telescope().wavelength);
  EXPECT_EQ(cost_of(configuration, false).wfe_scale, DesignCost().wfe_scale);
  EXPECT_EQ(cost_of(configuration, false).loop_weight, DesignCost().loop_weight);
}

TEST(Settings, EveryMeasureOfTheSeeingGivesTheSameFriedParameter) {
  EXPECT_DOUBLE_EQ(fried_parameter(with({{"seeing.d_over_r0", "4"}})), 0.125);
  EXPECT_DOUBLE_EQ(fried_parameter(with({{"seeing.fried_parameter", "12.5cm"}})), 0.125);
  // 0.976 x 532 nm / 12.5 cm in arcsec
  EXPECT_NEAR(fried_parameter(with({{"seeing.fwhm", "0.85680"}})), 0.125, 1e-5);
}

TEST(Settings, TheFriedParameterIsBroughtFromItsReferenceWavelengthToTheTelescopes) {
  EXPECT_NEAR(fried_parameter(with({{"seeing.fried_parameter", "10cm"},
                                    {"seeing.reference_wavelength", "500nm"},
                                    {"telescope.wavelength", "1um"}})),
              0.1 * std::pow(2.0, 1.2), 1e-12);
  // D/r0 is dimensionless at the telescope's wavelength, whatever the reference.
  EXPECT_DOUBLE_EQ(fried_parameter(with({{"seeing.d_over_r0", "4"},
                                         {"seeing.reference_wavelength", "500nm"},
                                         {"telescope.wavelength", "1um"}})),
                   0.125);
}

TEST(Settings, PlanesByDefaultKeepTheirFresnelNumbersAtAnotherTelescope) {
  Configuration configuration =
      with({{"telescope.diameter", "1.8m"}, {"telescope.wavelength", "850nm"}});
  scale_default_planes(configuration);
  const Telescope telescope = telescope_of(configuration);
  for (const auto& [planes, papers] :
       {std::pair{design_of(configuration).planes, design_of(Configuration()).planes},
        std::pair{baseline_of(configuration).planes, baseline_of(Configuration()).planes}}) {
    ASSERT_EQ(planes.size(), papers.size());
    for (std::size_t plane = 0; plane < planes.size(); ++plane) {
      EXPECT_NEAR(fresnel_number(telescope, planes[plane]),
                  fresnel_number(Telescope(), papers[plane]), 1e-9);
    }
  }
}

TEST(Settings, PlanesThatTheUserSetsStayWhereTheyAre) {
  Configuration configuration =
      with({{"telescope.diameter", "1.8m"}, {"sensor.planes", "-180km,180km,-47km,47km"}});
  scale_default_planes(configuration);
  EXPECT_THAT(configuration.lengths("sensor.planes"), ElementsAre(-180e3, 180e3, -47e3, 47e3));
  Configuration papers;
  scale_default_planes(papers);
  EXPECT_EQ(papers, Configuration());
}

TEST(Settings, TheBaselineDiffersOnlyInWhatItsSectionSets) {
  const Configuration configuration = with({{"reconstruction.relaxation", "0.5:0.1"},
                                            {"reconstruction.initial_guess", "centroid"},
                                            {"reconstruction.max_loops", "33"}});
  EXPECT_EQ(design_of(configuration).reconstruction.relaxation_start, 0.5);
  EXPECT_EQ(design_of(configuration).reconstruction.relaxation_end, 0.1);
  EXPECT_EQ(design_of(configuration).reconstruction.initial_guess, InitialGuess::centroid);
  const SensorDesign baseline = baseline_of(configuration);
  EXPECT_EQ(baseline.reconstruction.relaxation_start, 0.0);
  EXPECT_EQ(baseline.reconstruction.relaxation_end, 0.0);
  EXPECT_EQ(baseline.reconstruction.initial_guess, InitialGuess::flat);
  EXPECT_EQ(baseline.reconstruction.max_loops, 33);
  EXPECT_THAT(baseline.planes, ElementsAre(-47e3, 47e3, -180e3, 180e3));
}

TEST(Settings, TheSearchSpaceIsThatOfTheSectionSearch) {
  const Telescope telescope;
  const auto names_of = [&](const Configuration& configuration) {
    std::vector<std::vector<std::string>> names;
    const DesignSpace space = search_space_of(configuration, telescope, design_of(configuration));
    for (const SubSpace& sub_space : space.sub_spaces()) {
      auto& found = names.emplace_back();
      for (const Variable& variable : sub_space.variables) found.push_back(variable.name);
    }
    return names;
  };
  EXPECT_THAT(names_of(Configuration()),
              ElementsAre(ElementsAre("log z_near", "log z_far", "order")));
  EXPECT_THAT(names_of(with({{"search.layout", "free"},
                             {"search.plane_count", "2:3"},
                             {"search.z2", "5km"},
                             {"search.tolerance", "0.1nm:1nm"},
                             {"search.initial_guess", "centroid,flat"}})),
              ElementsAre(ElementsAre("log z1", "initial_guess", "log tolerance"),
                          ElementsAre("log z1", "log z3", "initial_guess", "log tolerance")));
  EXPECT_THAT(
      names_of(with(
          {{"search.plane_count", "3"}, {"search.order", "124"}, {"search.relaxation", "0:0.5"}})),
      ElementsAre(ElementsAre("log z_near", "log z_far", "relaxation")));
}

TEST(Settings, TheObjectiveIsThatOfItsSection) {
  const DesignCost cost = cost_of(with({{"objective.kind", "error_budget"},
                                        {"objective.terms", "loops:0.5"},
                                        {"objective.penalties", "loops>7:2"},
                                        {"objective.limits", "plane_count<4,loops<9"},
                                        {"objective.time_per_loop", "20us"},
                                        {"objective.readout_time_per_pixel", "1e-9"},
                                        {"objective.wind_speed", "12"},
                                        {"telescope.wavelength", "1um"}}),
                                  false);
  EXPECT_EQ(cost.kind, CostKind::error_budget);
  EXPECT_EQ(cost.terms.size(), 1u);
  EXPECT_EQ(cost.penalties.size(), 1u);
  EXPECT_EQ(cost.limits.size(), 2u);
  EXPECT_EQ(cost.operation.time_per_loop, 20e-6);
  EXPECT_EQ(cost.operation.readout_time_per_pixel, 1e-9);
  EXPECT_EQ(cost.operation.wind_speed, 12.0);
  EXPECT_EQ(cost.operation.greenwood_frequency, std::nullopt);
  EXPECT_EQ(cost.operation.wavelength, 1e-6);
}

TEST(Settings, DesignsOfDifferentPixelsAreComparedByTheirTotalErrorUnlessSaidOtherwise) {
  EXPECT_EQ(cost_of(Configuration(), false).wfe, WavefrontErrorKind::residual);
  EXPECT_EQ(cost_of(Configuration(), true).wfe, WavefrontErrorKind::total);
  for (const bool pixels_vary : {false, true}) {
    EXPECT_EQ(cost_of(with({{"objective.wfe", "wrapped"}}), pixels_vary).wfe,
              WavefrontErrorKind::wrapped);
    EXPECT_EQ(cost_of(with({{"objective.wfe", "residual"}}), pixels_vary).wfe,
              WavefrontErrorKind::residual);
  }
}

TEST(Settings, TheLightIsPerFrameOrPerSecond) {
  const Detector detector =
      design_of(with({{"detector.photon_rate", "1e8"}, {"detector.exposure", "2ms"}})).detector;
  EXPECT_EQ(detector.photon_rate, 1e8);
  EXPECT_EQ(detector.exposure, 2e-3);
  EXPECT_EQ(detector.photons_per_frame(), 2e5);
  EXPECT_EQ(design_of(Configuration()).detector.exposure, 0.0);
}

/// On few samples, quick to make.
DesignTrial quick_trial(std::initializer_list<std::pair<const char*, const char*>> values) {
  Configuration configuration = with(values);
  for (const auto& [key, value] : {std::pair{"detector.pupil_pixels", "16"},
                                   {"simulation.pupil_samples", "16"},
                                   {"screens.count", "3"}}) {
    configuration.set(key, value, "by the test");
  }
  Setup setup(configuration);
  return trial_of(setup, ScreenSource(configuration), setup.options.precision,
                  cost_of(configuration, false));
}

TEST(Settings, TheSourceIsThatOfItsSection) {
  EXPECT_TRUE(light_source_of(Configuration()).bands.empty());
  EXPECT_EQ(light_source_of(Configuration()).aberration, ChromaticAberration::path);
  const LightSource source = light_source_of(with({{"source.bands", "400nm:800nm"},
                                                   {"source.division", "split"},
                                                   {"source.wavelengths", "3"},
                                                   {"source.weights", "1,2,1"},
                                                   {"source.aberration", "phase"}}));
  EXPECT_EQ(source.bands, (std::vector<Band>{{400e-9, 800e-9}}));
  EXPECT_TRUE(source.is_split);
  EXPECT_EQ(source.wavelengths, 3);
  EXPECT_EQ(source.weights, (std::vector{1.0, 2.0, 1.0}));
  EXPECT_EQ(source.aberration, ChromaticAberration::phase);
  Configuration paper;
  paper.apply_preset("paper");
  EXPECT_EQ(light_source_of(paper).aberration, ChromaticAberration::phase);
}

TEST(Settings, TrialsAreUnderEachSeeingWithEachLight) {
  const DesignTrial trial =
      quick_trial({{"seeing.fried_parameter", "12.5cm,6.25cm"}, {"detector.photons", "0,1e5"}});
  std::vector<std::string> names;
  for (const Condition& condition : trial.conditions()) names.push_back(condition.name);
  EXPECT_THAT(names, ElementsAre("D/r0 = 4", "D/r0 = 4, 100000 photons", "D/r0 = 8",
                                 "D/r0 = 8, 100000 photons"));
  const std::vector<Condition>& conditions = trial.conditions();
  EXPECT_DOUBLE_EQ(conditions[0].fried_parameter, 0.125);
  EXPECT_DOUBLE_EQ(conditions[3].fried_parameter, 0.0625);
  EXPECT_EQ(conditions[2].light, 0.0);
  EXPECT_EQ(conditions[3].light, 1e5);
  EXPECT_EQ(conditions[0].simulation, conditions[1].simulation);
  EXPECT_NE(conditions[1].simulation, conditions[2].simulation);
  EXPECT_EQ(trial.screen_count(), 3);
}

TEST(Settings, OneSeeingAndOneLightAreOneConditionOfTheDesignsOwn) {
  const DesignTrial trial = quick_trial({{"detector.photons", "1e5"}});
  ASSERT_EQ(trial.conditions().size(), 1u);
  EXPECT_EQ(trial.conditions().front().light, std::nullopt);
  EXPECT_EQ(trial.conditions().front().name, "D/r0 = 4, 100000 photons");
}

TEST(Settings, LightsMayBePerSecond) {
  const DesignTrial trial =
      quick_trial({{"detector.photon_rate", "1e8,1e6"}, {"detector.exposure", "1ms"}});
  ASSERT_EQ(trial.conditions().size(), 2u);
  EXPECT_EQ(trial.conditions()[1].name, "D/r0 = 4, 1e+06 photons/s");
  EXPECT_EQ(
      trial.conditions()[1]
          .lit(design_of(with({{"detector.photon_rate", "1e8,1e6"}, {"detector.exposure", "1ms"}})))
          .detector.photons_per_frame(),
      1e3);
}

TEST(Settings, SeveralLightsMustFitTogether) {
  const auto message = [](std::initializer_list<std::pair<const char*, const char*>> values) {
    return message_of([&] { (void)quick_trial(values); });
  };
  EXPECT_EQ(message({{"detector.photons", "0,1e5"},
                     {"detector.photon_rate", "1e8"},
                     {"detector.exposure", "1ms"}}),
            "detector.photon_rate = 1e8: set only one of it and detector.photons, which is 0,1e5");
  EXPECT_EQ(message({{"detector.photon_rate", "1e8,0"}, {"detector.exposure", "1ms"}}),
            "detector.photon_rate = 1e8,0: several lights must all be above 0");
}

TEST(Settings, SeveralSeeingsHaveEachTheirValue) {
  const auto fried_parameters = [](const char* key, const char* values) {
    const Configuration configuration = with({{key, values}});
    std::vector<double> found;
    for (const Seeing& seeing : seeings_of(configuration, telescope_of(configuration))) {
      found.push_back(seeing.fried_parameter);
    }
    return found;
  };
  EXPECT_THAT(fried_parameters("seeing.d_over_r0", "4,8"), ElementsAre(0.125, 0.0625));
  EXPECT_THAT(fried_parameters("seeing.fried_parameter", "10cm,0.2"),
              ElementsAre(DoubleNear(0.1, 1e-12), DoubleNear(0.2, 1e-12)));
  EXPECT_THAT(fried_parameters("seeing.fwhm", "0.8568,1.7136"),
              ElementsAre(DoubleNear(0.125, 1e-5), DoubleNear(0.0625, 1e-5)));
}

TEST(Settings, TheAggregateIsThatOfTheObjective) {
  const auto aggregate = [](const char* kind) {
    return cost_of(with({{"objective.aggregate", kind}, {"objective.level", "0.75"}}), false)
        .aggregate;
  };
  EXPECT_EQ(aggregate("mean").kind, AggregateKind::mean);
  EXPECT_EQ(aggregate("worst").kind, AggregateKind::worst);
  EXPECT_EQ(aggregate("quantile").kind, AggregateKind::quantile);
  EXPECT_EQ(aggregate("cvar").kind, AggregateKind::cvar);
  EXPECT_EQ(aggregate("cvar").level, 0.75);
  EXPECT_EQ(cost_of(Configuration(), false).aggregate.level, CostAggregate().level);
}

TEST(Settings, TheVerificationsScreensMustBeFresh) {
  EXPECT_THAT(message_of([] {
                TrialSetup(with({{"verify.seed", "7"}, {"screens.seed", "7"}}));
              }),
              HasSubstr("verify.seed = 7: another seed than screens.seed"));
}

TEST(Settings, FreshScreensFitIntoTheMemoryThatIsAllowed) {
  // One screen in each seeing has room, but not as many as tell designs apart.
  EXPECT_THAT(message_of([] {
                TrialSetup(with({{"screens.count", "1"},
                                 {"simulation.pupil_samples", "8192"},
                                 {"seeing.d_over_r0", "1,2,3,4,5"}}))
                    .make_scan(false);
              }),
              AllOf(HasSubstr("screens.count = 8"), HasSubstr("take 20 GiB of memory")));
}

TEST(Settings, TheVerificationHasFourTimesTheSearchsScreensUnlessSaidOtherwise) {
  const auto screens = [](const char* count) {
    return TrialSetup(with({{"screens.count", count},
                            {"detector.pupil_pixels", "16"},
                            {"simulation.pupil_samples", "16"}}))
        .make_verification(false)
        .screen_count();
  };
  EXPECT_EQ(screens("2"), 64);
  EXPECT_EQ(screens("20"), 80);
}

TEST(Settings, ThePapersPresetKeepsItsFresnelNumbersAtAnotherTelescope) {
  Configuration configuration;
  configuration.apply_preset("paper");
  configuration.set("telescope.diameter", "1m", given);
  scale_default_planes(configuration);
  EXPECT_THAT(configuration.lengths("sensor.planes"), ElementsAre(-188e3, 188e3, -720e3, 720e3));
}

TEST(Settings, TheVerificationsTruthIsFinerAndNoLongerMatched) {
  const Configuration configuration = with({{"simulation.truth", "matched"},
                                            {"detector.pupil_pixels", "16"},
                                            {"verify.screens", "2"},
                                            {"verify.truth_factor", "2"}});
  const DesignTrial verification = TrialSetup(configuration).make_verification(false);
  EXPECT_EQ(verification.conditions().front().simulation->truth_samples(), 32);
  EXPECT_EQ(verification.screen_count(), 2);
  EXPECT_FALSE(verification.keeps_failures);
  EXPECT_FALSE(TrialSetup(configuration).make_scan(false).keeps_failures);
  // A matched simulation would widen the detector to the reconstruction's window.
  SensorDesign design = design_of(configuration);
  EXPECT_EQ(verification.checked(design).detector.window, design.detector.window);
}

Configuration with_trade_defaults(
    std::initializer_list<std::pair<const char*, const char*>> values) {
  Configuration configuration = with(values);
  set_trade_defaults(configuration);
  return configuration;
}

std::vector<double> pixels_traded(
    std::initializer_list<std::pair<const char*, const char*>> values) {
  const auto domain = with_trade_defaults(values).domain("search.pupil_pixels");
  return domain ? std::get<std::vector<double>>(*domain) : std::vector<double>();
}

TEST(Settings, ATradeVariesPlanesPixelsAndReconstruction) {
  const Configuration configuration = with_trade_defaults({});
  EXPECT_EQ(configuration.value_text("search.plane_count"), "2:5");
  EXPECT_EQ(configuration.value_text("search.layout"), "symmetric");
  EXPECT_EQ(configuration.value_text("search.relaxation"), "-0.3:0.7");
  EXPECT_EQ(configuration.value_text("search.initial_guess"), "flat,centroid");
  EXPECT_EQ(configuration.value_text("search.reconstruction_oversampling"), "1,2");
  EXPECT_EQ(configuration.value_text("search.pupil_pixels"), "16,32,64");
  Configuration again = configuration;
  set_trade_defaults(again);
  EXPECT_EQ(again, configuration);
}

TEST(Settings, ATradesPixelsSuitTheWindowsAndTheTruth) {
  EXPECT_THAT(pixels_traded({{"detector.pupil_pixels", "128"}}), ElementsAre(32, 64, 128));
  EXPECT_THAT(pixels_traded({{"detector.pupil_pixels", "8"}}), ElementsAre(4, 8));
  EXPECT_THAT(pixels_traded({{"detector.pupil_pixels", "32"}, {"detector.window", "1.0625"}}),
              testing::IsEmpty());
  EXPECT_THAT(pixels_traded({{"simulation.truth", "matched"}}), testing::IsEmpty());
  EXPECT_FALSE(with_trade_defaults({{"simulation.truth", "matched"}})
                   .is_set("search.reconstruction_oversampling"));
}

TEST(Settings, ATradeLeavesWhatTheUserSet) {
  const Configuration configuration =
      with_trade_defaults({{"search.plane_count", "4"},
                           {"search.pupil_pixels", "32"},
                           {"search.initial_guess", "flat"},
                           {"search.relaxation_start", "0:0.8"},
                           {"search.reconstruction_oversampling", "1"}});
  EXPECT_EQ(configuration.value_text("search.plane_count"), "4")
      << "though it is the default of optimize";
  EXPECT_EQ(configuration.value_text("search.pupil_pixels"), "32");
  EXPECT_EQ(configuration.value_text("search.initial_guess"), "flat");
  EXPECT_FALSE(configuration.is_set("search.relaxation"));
  EXPECT_EQ(configuration.value_text("search.reconstruction_oversampling"), "1");
  EXPECT_EQ(with_trade_defaults({{"search.z2", "5km:50km"}}).choice("search.layout"), "free");
}

}  // namespace
}  // namespace nlcwfs
