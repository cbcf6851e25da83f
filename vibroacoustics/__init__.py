"""Vibroacoustics of compressors: what moving parts do to the machine's feet and to the ear.

    >>> import vibroacoustics as va

**Studies.**
`load_study(path)` reads a `Study`; its method `replace({...})` changes values of it.
`run(study)` carries it from the machine's parameters to levels and scores, one `xarray.Dataset`.
`run_machines(study)` runs several machines of one study, an `xarray.DataTree`;
`open_machines(folder)` reads what the command wrote of one.
`radiate(study)` computes the housing's radiation alone.
`given_radiation(...)` makes measured transfer vectors what `run` takes.
`score(results)` scores and ranks the options again.
`sweep(study, {...})` computes every design of a grid or a sample of values;
`optimise(study)` searches for the best designs of its table `[design]`, which is a `Problem` for
searches of your own. `balance(study, option)` finds its counterweights, each `Balanced`.
`write_report(results, folder)` writes the report with tables and figures.
`data_sheet(results, option)` makes the data sheet of an option, a `DataSheet`, predicted;
`write_data_sheet(sheet, folder)` writes it as page, CSV and JSON.
`open_results(path)` reads results from a file; `estimate(results, variable, …)` gives a value
with its 80 % interval, an `Estimate`.
`export_forces(results, path)` writes their forces for a machine of `kind = "table"`.
`curves(study)` shows what goes on inside: pressures, films, friction, torques, critical speeds;
also of a machine alone, from `load_machine(path)`.

**Recordings.**
`read_recording(path)` reads a recording of any format.
`read_calibrator(path)` gives the factor of a microphone from the recording of a calibrator, a
`CalibratorReading`.
`open_recording(path)` opens one of any length, to be read in blocks.
`label_recording(...)` labels samples as one.
`export_recording(recording, path)` writes it as CSV, WAV or netCDF.
`read_modes(path)` reads measured modes of a structure.
`read_functions(path)` reads frequency responses and spectra, each a `MeasuredFunction` between two
`Node`s; `export_functions(functions, path)` writes them as UFF or CSV.
`analyse_orders(recording, settings)` finds orders and levels; settings are an `OrderAnalysis`.
`analyse_campaign(files, ...)` does so for many files, each a `CampaignRun`, with mean and scatter;
`load_campaign(path)` reads their common settings, a `Campaign`.
`track_orders(recording, ...)` follows orders over time (Vold-Kalman).
`replay(recording, results, ...)` changes its orders as an option of a study does, a `Replay`.
`sound_power(recordings, surface, ...)` gives a machine's sound power from the microphones around
it (ISO 3744), on a `MeasurementSurface`.
`speed_frequency_map(recording, ...)` gives spectra over speed and frequency (Campbell).
`compare(first, second)` compares orders of two results in level and phase.
`read_limits(path)` reads limits of orders, each a `Limit`.
`read_figure_limits(path)` reads limits of bands, totals and criteria too, each a `FigureLimit`.
`mean_of_runs(runs, specimens)` averages recordings of several runs and specimens.
`check_limits(results, limits)` holds orders of a recording, a study or a comparison against them.
`SpeedChannel`, `NominalSpeed`, `TacholessSpeed`, `SpeedLine` say where the speed comes from.

**Measurements alone.**
`hammer_test(path)` makes frequency responses of time records of hammer hits, `HammerResults`.
`predict(path)` predicts levels after a change of mounts, an added mass or an absorber, with a band;
`changed_response(...)` is its formula for arrays.
`blocked_forces(path)` finds the blocked forces of a source where it stands (ISO 20270);
`inverted_forces(...)` is its formula for arrays.
`balance_runs(path)` balances a machine on the bench from runs with trial weights, `BalancedRuns`
with each `PlacedWeight`.
`judge_permit(path)` judges units at windows by rules of authorities, a `PermitVerdict` each.

**Figures and arrays.**
`plot` has every figure as a function that returns a matplotlib Figure.
`orders` and `levels` have the steps of an analysis as functions of arrays, `sound` those of
listening, tones, loudness and sharpness, `rooms` the sound of a source in a furnished room.

**Sound.**
`listen(results, folder)` writes the sound of options at microphones as WAV or FLAC;
`impulse_responses(study)` are the responses in its room to accelerations of the machine.

**Things of your own.**
`register(thing)` and `load_plugin(path)` take them in: a class derived from `Option`, `Machine`,
`Source` or `Criterion`, or a `Section` or `Column` of the report, whose content `blocks` make.
A `Stage` of a run gets the `Chain` with `Cases` and results so far, and returns what is `Given`.
`Added`, `Case`, `Loads`, `MovingPart`, `Revolution`, `Wrench`, `OldhamRing`, `Slider` are what
these get and return; `circling`, `constant_rotation` and `wrenches_of_parts` make forces of moving
masses. Further results of an option are a `RingForce`, a `FurtherRing`, an `InsertionLoss` and
`AttachedBodies`, each a `RigidBody` held by a `Bushing` or several. A
machine has a `Rotation`, a `CrankFrame`, tables of `Parameters`, and for options each `Capability`,
such as a slider with `BalancePlanes`; `Held` marks values that are not sampled, a `Regime` the part
of a range in which another law holds. A `FileTable` takes values from a data file, by
`read_columns` from CSV.
Loads act at a `Port`: `HOUSING`, `BLOCK`, the parts `FIXED_SCROLL`, `BEARING_HOUSING`,
`ORBITING_SCROLL`, `LOWER_BEARING` and `STATOR`, the `STATOR_YOKE`, a `GasPort`; a `Tone` is a
line that is no order, `Noise` a random load. A `DesignFigure` of what is seen of designs, each a
`Need`, is what they can be judged by. A `Curve` over each `CurveAxis` shows what goes on inside. A
`Variable`, `Coordinate` or `Unit` joins the vocabulary; `stamp` labels an array as a variable,
`check` tests a dataset. A `Reader` reads a format of recordings: it gets a `Request` and gives
`Recorded`. `RatingRules` hold limits and adjustments of a country; a `PermitRule` judges a
`PermitUnit` at a window by each `CalculationLine`.

**Errors.** All derive from `VibroacousticsError`, each message is one line: `ParameterError`,
`SolverError`, `StorageError`, `SchemaError`, `PluginError`. Doubtful recordings are a
`RecordingWarning`, doubtful pulses of a tacho a `PulseWarning`.
"""

from .base.lazy import public_names

__getattr__, __dir__, __all__ = public_names(__name__, __file__)
