//! Compares queries over workers, by TCP, with those of a single process.

use std::path::PathBuf;
use std::time::Duration;

use datafusion::arrow::array::RecordBatch;
use datafusion_distributed::display_plan_ascii;
use robot_query::cluster::{Listener, Workers, serve};
use robot_query::identify::Estimate;
use robot_query::log::{Log, Session, Settings};
use robot_query::{Error, Robots};
use tokio::runtime::Runtime;

use super::support::{difference, files, generation, log, robot, rows, rows_of};

const SETTINGS: Settings = Settings { threads: 2, memory: 1 << 30 };

/// A worker with a runtime of its own, which can end at any time.
struct Worker {
    runtime: Runtime,
    address: String,
}

impl Worker {
    fn start() -> Worker {
        let runtime = Runtime::new().unwrap();
        let listener = runtime.block_on(Listener::bind("127.0.0.1:0")).unwrap();
        let address = listener.address.to_string();
        runtime.spawn(serve(listener, Robots::new(), 1 << 30));
        Worker { runtime, address }
    }

    /// Ends the worker and its connections.
    fn kill(self) {
        self.runtime.shutdown_background();
    }
}

fn addresses(workers: &[Worker]) -> Vec<String> {
    workers.iter().map(|worker| worker.address.clone()).collect()
}

/// The rows of a query over a log, computed by workers.
fn asked(addresses: &[String], files: &[PathBuf], query: &str) -> Result<RecordBatch, Error> {
    let session = Session::on(Robots::new(), SETTINGS, Workers::at(addresses)?)?;
    rows_of(&session, files, query)
}

/// The plan of a query, including its stages.
fn planned(addresses: &[String], files: &[PathBuf], query: &str) -> String {
    let workers = Workers::at(addresses).unwrap();
    Runtime::new().unwrap().block_on(async {
        let session = Session::on(Robots::new(), SETTINGS, workers).unwrap();
        let table = session.table(&Log::open(files).unwrap()).await.unwrap();
        session.context.register_table("log", table.into_view()).unwrap();
        let table = session.context.sql(query).await.unwrap();
        display_plan_ascii(table.create_physical_plan().await.unwrap().as_ref(), false)
    })
}

#[test]
fn three_workers_give_the_answer_of_one_process() {
    let path = robot("ur5");
    let folder = log(&path, &generation(&path, 60_000));
    let files = files(folder.path());
    let workers = [(); 3].map(|()| Worker::start());
    let addresses = addresses(&workers);
    let query = format!("SELECT identify('{path}', q, qd, qdd, tau) FROM log");
    let plan = planned(&addresses, &files, &query);
    assert!(plan.contains("tasks=3"), "{plan}");
    let estimate =
        |answer: RecordBatch| Estimate::from_array(answer.column(0), 0).unwrap().unwrap();
    let found = estimate(asked(&addresses, &files, &query).unwrap());
    let alone = estimate(rows(1, &files, &query).unwrap());
    assert_eq!((found.rows, found.excluded), (60_000, 0));
    assert!(difference(&found.values, &alone.values) < 1e-12);
    assert!(difference(&found.covariance, &alone.covariance) < 1e-9);
    // Queries also return rows, in groups.
    let query = format!(
        "SELECT episode, count(*), sum(energies('{path}', q, qd)['kinetic']) AS e FROM log GROUP BY episode ORDER BY episode"
    );
    let found = asked(&addresses, &files, &query).unwrap();
    let alone = rows(1, &files, &query).unwrap();
    assert_eq!(found.num_rows(), 60);
    assert_eq!(found.column(1), alone.column(1));
}

#[test]
fn a_worker_that_ends_gives_the_right_answer_or_an_error() {
    let path = robot("ur5");
    let folder = log(&path, &generation(&path, 300_000));
    let files = files(folder.path());
    let query = format!("SELECT identify('{path}', q, qd, qdd, tau, 1.0) FROM log");
    let estimate =
        |answer: RecordBatch| Estimate::from_array(answer.column(0), 0).unwrap().unwrap();
    let alone = estimate(rows(1, &files, &query).unwrap());
    let mut lost = 0;
    for pause in [0, 20, 60, 150, 300] {
        let mut workers: Vec<Worker> = (0..3).map(|_| Worker::start()).collect();
        let addresses = addresses(&workers);
        // The machine code is compiled before the worker ends.
        let warm = format!("{query} WHERE t < 1");
        assert!(asked(&addresses, &files, &warm).is_ok());
        let answer = std::thread::scope(|scope| {
            let running = scope.spawn(|| asked(&addresses, &files, &query));
            std::thread::sleep(Duration::from_millis(pause));
            workers.remove(1).kill();
            running.join().unwrap()
        });
        match answer {
            Ok(answer) => {
                let found = estimate(answer);
                assert_eq!(found.rows, 300_000);
                assert!(difference(&found.values, &alone.values) < 1e-12, "after {pause} ms");
            }
            Err(error) => {
                lost += 1;
                let text = error.to_string();
                assert!(text.contains("worker"), "after {pause} ms: {text}");
            }
        }
        workers.into_iter().for_each(Worker::kill);
    }
    assert!(lost > 0, "no worker ended in the middle");
}

#[test]
fn workers_that_cannot_be_reached_are_named() {
    let gone = Worker::start();
    let address = gone.address.clone();
    gone.kill();
    std::thread::sleep(Duration::from_millis(200));
    let error = Workers::at(std::slice::from_ref(&address)).unwrap_err().to_string();
    assert!(error.contains(&format!("worker {address}:")), "{error}");
    assert!(Workers::at(&["nowhere".to_owned()]).is_err());
}
