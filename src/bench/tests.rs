use std::collections::BTreeMap;

use voltour_solver::plan::Status;
use voltour_solver::solvers::SolverName;

use super::*;

fn settings(trained: &Trained) -> Settings {
    Settings {
        version: "0".to_owned(),
        seed: 3,
        time_limit_s: 20.0,
        iterations: 50,
        memory_mib: 64,
        policies: trained.digests(),
    }
}

fn run(index: u64, algorithm: &str, status: Status, objective: f64) -> Run {
    Run {
        group: "g".to_owned(),
        index,
        algorithm: algorithm.to_owned(),
        status,
        objective,
        bound: None,
        stops: 1,
        seconds: 0.25,
        compile_s: 0.5,
        ended: Ended::Itself,
    }
}

#[test]
fn every_figure_of_the_paper_is_one_of_a_table() {
    let figures = published();
    assert_eq!(figures.count(), include_str!("published.csv").lines().count() - 1);
    let mut found = 0;
    for table in tables() {
        for setting in &table.settings {
            for entrant in setting.entrants.iter().filter(|entrant| entrant.is_the_papers()) {
                let of = figures.of(table.name, setting.x, entrant.solver.name());
                // What the paper leaves out did not finish: dp in four of its settings.
                let missing = entrant.solver == SolverName::Dp && of.seconds.is_none();
                found += usize::from(of.seconds.is_some() || missing);
            }
        }
    }
    assert_eq!(found, figures.count());
}

#[test]
fn a_cell_of_two_tables_is_run_once() {
    let tables = tables();
    let jobs = paper_jobs(&tables, 2, 0);
    let mut seen: Vec<(String, u64)> = jobs.iter().map(|job| (job.group(), job.index)).collect();
    let count = seen.len();
    seen.sort();
    seen.dedup();
    assert_eq!(seen.len(), count);
    let mobile = jobs.iter().find(|job| job.group() == "mobile/10").unwrap();
    let names: Vec<String> = mobile.entrants.iter().map(ToString::to_string).collect();
    for name in ["app-90", "app-180", "app-300", "dqn", "exact"] {
        assert_eq!(names.iter().filter(|n| *n == name).count(), 1, "{names:?}");
    }
    // The first of every cell comes first.
    assert!(jobs[..count / 2].iter().all(|job| job.index == 0));
}

#[test]
fn a_bench_goes_on_where_it_was_cut_off() {
    let folder = tempfile::tempdir().unwrap();
    let trained = Trained::embedded().unwrap();
    let settings = settings(&trained);
    let tables: Vec<Table> =
        tables().into_iter().filter(|table| table.name == "reward-capacity").collect();
    let bench = |scenarios: u64| {
        let mut log = Log::open(folder.path(), &settings).unwrap();
        let mut told = 0;
        let jobs = paper_jobs(&tables, scenarios, settings.seed);
        work(&jobs, &mut log, &settings, &trained, 2, |_| told += 1).unwrap();
        (told, log.runs().to_vec())
    };
    let (first, _) = bench(1);
    assert_eq!(first, 4 * 8);
    // Half a line is what an interruption leaves.
    let path = folder.path().join("runs.csv");
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, &text[..text.len() - 20]).unwrap();
    let (again, runs) = bench(2);
    assert_eq!(again, 1 + 4 * 8);
    // Same seed, same tours: but for the times, a fresh bench gives the same rows.
    let fresh = tempfile::tempdir().unwrap();
    let mut log = Log::open(fresh.path(), &settings).unwrap();
    let jobs = paper_jobs(&tables, 2, settings.seed);
    work(&jobs, &mut log, &settings, &trained, 1, |_| ()).unwrap();
    let rows = |runs: &[Run]| -> BTreeMap<(String, u64, String), (Status, u64, usize)> {
        let key = |run: &Run| (run.group.clone(), run.index, run.algorithm.clone());
        let value = |run: &Run| (run.status, run.objective.to_bits(), run.stops);
        runs.iter().map(|run| (key(run), value(run))).collect()
    };
    assert_eq!(rows(&runs), rows(log.runs()));
    let sheet = Sheet::of(&tables[0], &runs, &published()).unwrap();
    for row in &sheet.rows {
        assert_eq!(row.summary.solved, 2, "{row:?}");
        assert!(row.summary.mean_gap.unwrap() < 1.0);
        assert!(row.published.seconds.is_some() || row.summary.algorithm.len() > 3);
    }
    let exact = sheet.rows.iter().filter(|row| row.summary.algorithm == "exact");
    assert!(
        exact.clone().count() == 4 && exact.clone().all(|row| row.summary.largest_gap == Some(0.0))
    );
    let text = sheet.markdown(Some((2_000.0, 8)));
    assert!(text.contains("| 200 | mst | ") && text.contains("250 s for each of the 8"), "{text}");
    let head = String::from_utf8(sheet.csv().unwrap()).unwrap();
    assert_eq!(head.lines().count(), 1 + sheet.rows.len());
    let drawing = plot(&sheet).unwrap();
    let drawing = roxmltree::Document::parse(&drawing).unwrap();
    let texts: Vec<&str> =
        drawing.descendants().filter_map(|node| node.text()).map(str::trim).collect();
    assert!(["cmst", "exact", "capacity, kJ"].iter().all(|name| texts.contains(name)), "{texts:?}");
}

#[test]
fn runs_under_other_settings_are_not_mixed() {
    let folder = tempfile::tempdir().unwrap();
    let trained = Trained::default();
    let settings = settings(&trained);
    Log::open(folder.path(), &settings).unwrap();
    Log::open(folder.path(), &settings).unwrap();
    let other = Settings { seed: 4, ..settings };
    let error = Log::open(folder.path(), &other).unwrap_err().to_string();
    assert!(error.contains("seed is 3") && error.contains("not 4"), "{error}");
}

#[test]
fn a_broken_promise_is_an_error() {
    let optimal = run(0, "exact", Status::Optimal, 100.0);
    let better = run(0, "acs", Status::Feasible, 99.0);
    let error = references(&[optimal.clone(), better.clone()], "g", true).unwrap_err();
    assert!(
        matches!(&error, BenchError::Defect { algorithm, .. } if algorithm == "exact"),
        "{error}"
    );
    // Where more is better, the same two agree.
    let known = references(&[optimal, better], "g", false).unwrap();
    assert_eq!(known[&0], Reference { objective: Some(100.0), proven: true });
    let none = run(1, "exact", Status::Infeasible, 0.0);
    let some = run(1, "acs", Status::Feasible, 7.0);
    assert!(references(&[none, some], "g", true).is_err());
}

#[test]
fn what_is_not_solved_or_not_finished_is_counted() {
    let mut late = run(1, "dp", Status::BestEffort, 0.0);
    late.ended = Ended::Memory;
    let mut cut = run(2, "dp", Status::Feasible, 120.0);
    cut.ended = Ended::Time;
    let runs = [
        run(0, "exact", Status::Optimal, 100.0),
        run(1, "exact", Status::Optimal, 100.0),
        run(2, "exact", Status::Optimal, 100.0),
        run(3, "exact", Status::Infeasible, 0.0),
        run(0, "dp", Status::Feasible, 110.0),
        late,
        cut,
        run(3, "dp", Status::BestEffort, 0.0),
    ];
    let known = references(&runs, "g", true).unwrap();
    let found = summaries(&runs, "g", &known, &["dp".to_owned()]);
    let [dp] = &found[..] else { panic!("{found:?}") };
    assert_eq!((dp.feasible, dp.solved, dp.unfinished, dp.cut_short), (3, 2, 1, 1));
    assert!((dp.mean_gap.unwrap() - 0.15).abs() < 1e-12);
    assert_eq!(dp.mean_objective, Some(115.0));
}

#[test]
fn a_document_keeps_what_is_around_its_tables() {
    let document =
        "a\n<!-- bench t -->\nold\n<!-- bench end -->\nb\n<!-- bench u -->\n<!-- bench end -->\n";
    let renewed = replaced(document, "u", "new\n").unwrap();
    assert!(
        renewed.contains("old")
            && renewed.ends_with("<!-- bench u -->\n\nnew\n\n<!-- bench end -->\n")
    );
    let renewed = replaced(&renewed, "t", "newer").unwrap();
    assert!(
        renewed.starts_with("a\n<!-- bench t -->\n\nnewer\n\n<!-- bench end -->\nb\n"),
        "{renewed}"
    );
    assert_eq!(replaced(document, "v", ""), None);
}

#[test]
fn public_instances_are_held_against_their_best_values() {
    let folder = tempfile::tempdir().unwrap();
    let lines = "file,objective,best_known,proven,source\n../x.json,max_reward,10,yes,s\n";
    std::fs::write(folder.path().join("best.csv"), lines).unwrap();
    let error = Public::read(folder.path()).unwrap_err().to_string();
    assert!(error.contains("must be the name of a file"), "{error}");
    let lines = "file,objective,best_known,proven,source\nx.json,max_reward,10,yes,s\ny.json,min_distance,50,no,t\n";
    std::fs::write(folder.path().join("best.csv"), lines).unwrap();
    let public = Public::read(folder.path()).unwrap();
    let entrants = [Entrant::plain(SolverName::Exact), Entrant::plain(SolverName::Greedy)];
    assert_eq!(public.jobs(&entrants).len(), 2);
    let at = |file: &str, algorithm: &str, status, objective| Run {
        group: file.to_owned(),
        ..run(0, algorithm, status, objective)
    };
    let runs = [
        at("x.json", "exact", Status::Optimal, 11.0),
        at("x.json", "greedy", Status::Feasible, 9.0),
        at("y.json", "exact", Status::Optimal, 50.0),
        at("y.json", "greedy", Status::BestEffort, 0.0),
    ];
    let text = public.markdown(&runs, &entrants);
    assert!(text.contains("| 11.00, 10.00 %!, 250 ms | 9.00, 10.00 %, 250 ms |"), "{text}");
    assert!(text.contains("| 50 (not proven) | 50.00, 0.00 %, 250 ms | none, 250 ms |"), "{text}");
    assert!(text.contains("| exact | 2 of 2 | 1 | 5.00 % | 10.00 % |"), "{text}");
    assert!(text.contains("| greedy | 1 of 2 | 0 | 10.00 % | 10.00 % |"), "{text}");
}
