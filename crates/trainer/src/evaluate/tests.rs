use voltour_solver::generate::{Cell, FIRST_TEST_SEED};
use voltour_solver::instance::Instance;
use voltour_solver::policy::Problem;
use voltour_solver::policy::guided::Rule;
use voltour_solver::scenario::Scenario;

use super::{METHODS, Method, Optima, Optimum, Paired, Run, Summary, Table};

#[test]
fn every_method_is_read_back_by_its_name() {
    for name in METHODS {
        assert_eq!(name.parse::<Method>().unwrap().to_string(), name);
    }
    for wrong in ["", "beam", "sample+", "greedy+more", "control-", "k_coverage"] {
        assert!(wrong.parse::<Method>().is_err(), "{wrong}");
    }
}

#[test]
fn proofs_are_kept_in_their_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("optima.csv");
    let cell: Cell = "mobile/10".parse().unwrap();
    let scenario = Scenario::from_document(&cell.draw(FIRST_TEST_SEED).unwrap()).unwrap();
    let instance = Instance::new(&scenario);
    let found = Optima::open(Some(&file), 5.0).unwrap().of("mobile/10:0", &instance).unwrap();
    assert!(found.proven && found.objective.is_some());
    // Without time to prove anything, the answer comes from the file.
    let again = Optima::open(Some(&file), 0.0).unwrap().of("mobile/10:0", &instance).unwrap();
    assert_eq!(again, found);
}

#[test]
fn every_method_builds_a_tour_no_better_than_the_optimum() {
    for cell in ["k_coverage/32/2/0.4", "dense/20", "mobile/8"] {
        let cell: Cell = cell.parse().unwrap();
        let scenario = Scenario::from_document(&cell.draw(FIRST_TEST_SEED + 1).unwrap()).unwrap();
        let instance = Instance::new(&scenario);
        let optimum = Optima::open(None, 20.0).unwrap().of("", &instance).unwrap();
        let best = optimum.objective.unwrap();
        let rule = Rule(cell.problem());
        for name in METHODS {
            let method: Method = name.parse().unwrap();
            let run = method.run(&instance, &rule, 1, 0.05, 0.002).unwrap();
            let Some(objective) = run.objective else { continue };
            let better = if cell.problem() == Problem::KCoverage {
                objective < best * (1.0 - 1e-9)
            } else {
                objective > best * (1.0 + 1e-9)
            };
            assert!(!better, "{name} on {cell}: {objective} beats the proven {best}");
        }
    }
}

#[test]
fn a_table_counts_what_was_solved() {
    let mut summary = Summary::default();
    let run = Run { objective: Some(110.0), roll_outs: 4, valued: 20, seconds: 0.5 };
    summary.add(&run, 100.0);
    summary.add(&Run { objective: None, ..run }, 100.0);
    assert_eq!(summary.solved_share(), 0.5);
    let optimum = Optimum { objective: Some(100.0), proven: true };
    let mut table = Table::default();
    table.push("mobile/8", "greedy", &[optimum; 2], summary);
    assert!(table.csv().ends_with("mobile/8,greedy,2,2,1,0.100000,0.100000,4.0,20.0,0.500000\n"));
    assert!(table.markdown().contains("| mobile/8 | greedy | 1 of 2 | 10.00 % | 4 | 20 | 500.0 |"));
}

#[test]
fn a_comparison_is_of_scenarios_not_of_seeds() {
    let mut paired = Paired::default();
    assert_eq!(paired.margin(), f64::INFINITY);
    // Two seeds each; the third scenario is solved by one of the two alone.
    paired.add([(Some(0.01), Some(0.03)), (Some(0.0), Some(0.0))]);
    paired.add([(Some(0.04), Some(0.0)), (Some(0.02), Some(0.0))]);
    paired.add([(Some(0.0), None), (None, None)]);
    assert_eq!((paired.better, paired.equal, paired.worse), (2, 2, 2));
    // Of -0.01 and 0.03: mean 0.01, standard deviation 0.0283, standard error 0.02.
    assert!((paired.mean() - 0.01).abs() < 1e-12);
    assert!((paired.margin() - 1.96 * 0.02).abs() < 1e-12);
    let mut table = Table::default();
    assert_eq!(table.comparisons(), "");
    table.compare("mobile/8", "auto - baseline", paired);
    let row = "| mobile/8 | auto - baseline | +1.000 | -2.920 to +4.920 | 2 | 2 | 2 |\n";
    assert!(table.comparisons().ends_with(row), "{}", table.comparisons());
}
